#pragma once

namespace lemma {

/// What the program says to its caller.
enum ExitCode {
  kDone = 0,
  kBadInput = 1,         // bad scene, arguments or files
  kInvalidSamples = 2,   // done, but samples that were NaN, infinite or negative were left out
  kComparisonFailed = 3  // what should be equal is not
};

}  // namespace lemma
