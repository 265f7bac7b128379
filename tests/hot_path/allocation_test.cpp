#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "src/core/parallel.h"
#include "tests/support/images.h"

namespace {

std::atomic<std::uint64_t> allocations{0};

void* allocate(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// In place of the library's, for the whole program of this test.
void* operator new(std::size_t bytes) {
  return allocate(bytes);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace lemma {
namespace {

std::uint64_t allocations_of(const Scene& scene, const test::Configuration& configuration,
                             std::uint32_t spp) {
  const std::uint64_t before = allocations;
  (void)test::render_scene(scene, configuration, {.spp = spp});
  return allocations - before;
}

/// Rendering 16 times the samples takes not one allocation more: none is made for a sample, a path or a ray.
TEST(HotPath, NoAllocationPerSample) {
  const ThreadLimit one_thread(1);  // starting threads allocates
  for (const char* name : {"veach-mis", "cornell-box"}) {
    const Scene scene = test::own_scene(name, 24, 16);
    for (const char* accel : {"embree", "grid"}) {
      for (const auto& integrator : integrators()) {
        for (const auto& lights : light_samplers()) {
          const test::Configuration configuration{accel, integrator.name, lights.name};
          (void)allocations_of(scene, configuration, 1);  // what is made once
          const std::uint64_t few = allocations_of(scene, configuration, 2);
          EXPECT_GT(few, 0u) << "allocations are not counted";
          EXPECT_EQ(allocations_of(scene, configuration, 32), few)
              << name << " " << accel << " " << integrator.name << " " << lights.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lemma
