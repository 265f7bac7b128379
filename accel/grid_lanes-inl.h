// Included once for every instruction set that accel/grid_trace.cpp is compiled for.
#if defined(LEMMA_GRID_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LEMMA_GRID_LANES_INL_H
#undef LEMMA_GRID_LANES_INL_H
#else
#define LEMMA_GRID_LANES_INL_H
#endif

#include <hwy/highway.h>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace lemma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i of a mask's lanes, of which there are at most 16.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
  alignas(8) std::uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  if constexpr (hn::MaxLanes(d) <= 8) return bytes[0];
  std::uint16_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace lemma
HWY_AFTER_NAMESPACE();

#endif
