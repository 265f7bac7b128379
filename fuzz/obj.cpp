#include "fuzz/read_text.h"
#include "src/scene/obj_shape.h"
#include "src/scene/read_obj.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lemma;
  return fuzz::read_text("a.obj", data, size, [](const std::string& text, Warnings& warnings) {
    const ObjFile obj = parse_obj("a.obj", text, warnings, {.bytes = 1u << 30, .triangles = 1u << 20});
    for (const ObjTriangle& t : obj.triangles) {  // every index in range, or the address sanitizer says so
      (void)soundness_of(shape_of(obj, t));
      for (const std::uint32_t n : t.normal) {
        if (n != kNoIndex && n >= obj.normals.size()) __builtin_trap();
      }
      for (const std::uint32_t n : t.texcoord) {
        if (n != kNoIndex && n >= obj.texcoords.size()) __builtin_trap();
      }
      if (t.material >= obj.materials.size()) __builtin_trap();
    }
  });
}
