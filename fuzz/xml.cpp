#include "fuzz/read_text.h"
#include "src/scene/camera.h"
#include "src/scene/read_xml.h"
#include "src/scene/spheres.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lemma;
  return fuzz::read_text("a.xml", data, size, [](const std::string& text, Warnings& warnings) {
    const XmlScene scene = parse_xml("a.xml", text, warnings);
    const Ray ray = Camera(scene.view).ray_through(0.5f, 0.5f);
    ObjFile obj;
    if (scene.spheres.size() < 8) add_spheres(scene.spheres, obj);
    if (!is_finite(ray.origin)) __builtin_trap();
  });
}
