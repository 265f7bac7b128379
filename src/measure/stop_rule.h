#pragma once

#include <cstdint>
#include <optional>

namespace lemma {

/// When a rendering is done: at a number of samples, when its time is up, or when its estimated error is
/// small enough; whichever comes first.
struct StopRule {
  std::uint32_t spp = 0;               // samples a pixel at most
  std::optional<double> seconds = {};  // of rendering proper; at least one sample a pixel is rendered
  std::optional<double> relmse = {};   // estimated; looked at from kFirstLook samples on
  bool looks = false;                  // stop at every doubling, to be looked at

  /// Fewer samples would often miss what is rare, and then the error looks small.
  static constexpr std::uint32_t kFirstLook = 16;
};

/// What is known of a rendering between two passes.
struct PassState {
  std::uint32_t spp = 0;  // done
  double seconds = 0;     // used
  double relmse = 0;      // estimated; not used at less than kFirstLook samples
};

/// Samples a pixel that the rendering should have after the next pass; state.spp if it is done. Without need
/// for several passes there is one. Else samples double from pass to pass, which costs few passes and gives
/// the sequence the powers of two that it likes; the last pass goes as far as time lasts, or, in quarters of
/// the samples so far, as the error seems to need.
[[nodiscard]] std::uint32_t next_spp(const StopRule& rule, const PassState& state);

}  // namespace lemma
