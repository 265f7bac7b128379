#include "fuzz/read_text.h"
#include "src/scene/glass.h"
#include "src/scene/read_mtl.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lemma;
  return fuzz::read_text("a.mtl", data, size, [](const std::string& text, Warnings& warnings) {
    for (const MtlMaterial& m : parse_mtl("a.mtl", text, warnings)) {
      const float ior = glass_of(m).ior;
      if (!(ior > 0) || !(m.ns >= 0 && m.ns <= 1e6f) || !(max_channel(m.kd) >= 0)) __builtin_trap();
    }
  });
}
