#pragma once

#include <algorithm>

#include "src/core/wave.h"

namespace lemma {

/// Some lanes of a wave, in order.
class LaneList {
 public:
  void clear() { count_ = 0; }

  /// Adds a lane, without a branch, if it is wanted.
  /// @param lane  beyond those that were offered before
  void add_if(bool wanted, std::size_t lane) {
    lanes_[count_] = static_cast<std::uint32_t>(lane);
    count_ += wanted ? 1 : 0;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t operator[](std::size_t k) const { return lanes_[k]; }

  // Lane k of `to` becomes the k-th of these lanes of `from`.

  template <class T>
  void gather(const Wave<T>& from, Wave<T>& to) const {
    if (leaves_none_out()) {
      std::copy_n(from.values, count_, to.values);
    } else {
      for (std::size_t k = 0; k < count_; ++k) to[k] = from[lanes_[k]];
    }
  }
  void gather(const VecWave& from, VecWave& to) const {
    gather(from.x, to.x), gather(from.y, to.y), gather(from.z, to.z);
  }

  // The lanes move together: lane k becomes what the k-th of them was.

  template <class T>
  void keep(Wave<T>& wave) const {
    if (leaves_none_out()) return;
    for (std::size_t k = 0; k < count_; ++k) wave[k] = wave[lanes_[k]];
  }
  void keep(VecWave& wave) const { keep(wave.x), keep(wave.y), keep(wave.z); }
  void keep(RgbWave& wave) const { keep(wave.r), keep(wave.g), keep(wave.b); }

 private:
  /// Whether they are the first lanes of the wave.
  [[nodiscard]] bool leaves_none_out() const { return count_ == 0 || lanes_[count_ - 1] == count_ - 1; }

  Wave<std::uint32_t> lanes_;
  std::size_t count_ = 0;
};

}  // namespace lemma
