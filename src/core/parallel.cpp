#include "src/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace lemma {

struct ThreadLimit::Control {
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(nullptr), threads_(threads > 0 ? threads : tbb::info::default_concurrency()) {
  control_ = new Control{
      tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_))};
}

ThreadLimit::~ThreadLimit() {
  delete control_;
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>(threads));
  // The two atomics say to the memory model (and to a thread sanitizer, which cannot look into the TBB
  // library) what fork and join already guarantee: bodies start after the caller's writes, the caller resumes
  // after theirs.
  std::atomic<int> started{0}, finished{0};
  started.store(1, std::memory_order_release);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      (void)started.load(std::memory_order_acquire);
      body(i);
      finished.fetch_add(1, std::memory_order_release);
    });
  });
  (void)finished.load(std::memory_order_acquire);
}

}  // namespace lemma
