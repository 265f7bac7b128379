#include "src/core/tbb_loop.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace lemma {

struct TbbLimit::Control {
  tbb::global_control limit;
};

TbbLimit::TbbLimit(int threads)
    : control_(new Control{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads))}) {}

TbbLimit::~TbbLimit() = default;

int tbb_threads() {
  return tbb::info::default_concurrency();
}

void tbb_loop(std::size_t count, void (*call)(const void* argument, std::size_t i), const void* argument) {
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, [=](std::size_t i) { call(argument, i); }); });
}

}  // namespace lemma
