#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "src/app/ray_file.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto rays = lemma::parse_rays("rays.f32", {reinterpret_cast<const char*>(data), size});
    if (rays.size() * 32 != size) __builtin_trap();
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
