#include "src/core/sampler.h"

namespace lemma {

std::span<const Named<Sequence>> sequences() {
  static constexpr Named<Sequence> table[] = {
      {"sobol", Sequence::sobol, "a pixel's samples are spread evenly (Owen-scrambled Sobol)"},
      {"independent", Sequence::independent, "every number is drawn by itself"}};
  return table;
}

}  // namespace lemma
