#include "src/core/alias_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lemma {

AliasTable::AliasTable(std::span<const double> weights) : entries_(weights.size()) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto n = static_cast<double>(weights.size());
  std::vector<double> scaled(weights.size());  // mean 1
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    scaled[i] = weights[i] / sum * n;
    entries_[i].pmf = static_cast<float>(weights[i] / sum);
    entries_[i].alias = i;
    entries_[i].threshold = std::uint64_t{1} << 32;
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t poor = small.back(), rich = large.back();
    small.pop_back();
    entries_[poor].threshold = static_cast<std::uint64_t>(std::llround(std::ldexp(scaled[poor], 32)));
    entries_[poor].alias = rich;
    scaled[rich] -= 1 - scaled[poor];
    if (scaled[rich] < 1) {
      large.pop_back();
      small.push_back(rich);
    }
  }
  // Rounding leaves entries near 1 in either list; one of weight 0 must not stay reachable.
  const auto heaviest =
      static_cast<std::uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const std::uint32_t i : small) {
    if (weights[i] == 0) entries_[i].threshold = 0, entries_[i].alias = heaviest;
  }
}

std::uint32_t AliasTable::sample(std::uint32_t bits) const {
  const std::uint64_t product = std::uint64_t{bits} * entries_.size();
  const auto index = static_cast<std::uint32_t>(product >> 32);
  const std::uint64_t fraction = product & 0xFFFFFFFFu;
  return fraction < entries_[index].threshold ? index : entries_[index].alias;
}

}  // namespace lemma
