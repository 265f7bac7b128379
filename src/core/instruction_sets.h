#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace lemma {

/// What `get` returns while each of the instruction sets that this machine can run is the chosen one, the
/// fastest first: `get` is a HWY_DYNAMIC_DISPATCH. Not to be called by two threads at once.
template <class Get>
[[nodiscard]] auto for_every_instruction_set(const Get& get) {
  std::vector<decltype(get())> all;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    all.push_back(get());
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return all;
}

}  // namespace lemma
