#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lemma {

/// Draws index i with probability weight_i / (sum of weights) in constant time.
/// Source: Vose, A Linear Algorithm for Generating Random Numbers with a Given Distribution, 1991.
class AliasTable {
 public:
  /// @param weights  finite and >= 0, at least one > 0. An entry of weight 0 is never drawn.
  explicit AliasTable(std::span<const double> weights);

  /// The index for `bits`, uniform over all 32-bit integers.
  [[nodiscard]] std::uint32_t sample(std::uint32_t bits) const;

  /// The probability with which sample() returns `index`, to 2^-32 absolute.
  [[nodiscard]] float pmf(std::uint32_t index) const { return entries_[index].pmf; }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint64_t threshold =
        0;  // in [0, 2^32]: a fraction below it keeps this entry, else the alias is taken
    std::uint32_t alias = 0;
    float pmf = 0;
  };
  std::vector<Entry> entries_;
};

}  // namespace lemma
