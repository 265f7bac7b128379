#include "src/core/parallel.h"

#include <atomic>

namespace lemma {
namespace {

// What fork and join guarantee, said once more in a way that a thread sanitizer sees, which cannot look into
// TBB: bodies start after the caller's writes, and the caller goes on after theirs. Between bodies these
// order nothing, so that a race of two bodies is still found.
std::atomic<unsigned> forks{0}, joins{0};

struct Join {
  Join() = default;
  ~Join() { joins.fetch_add(1, std::memory_order_release); }
  Join(const Join&) = delete;
  Join& operator=(const Join&) = delete;
};

void run_body(const void* body, std::size_t i) {
  (void)forks.load(std::memory_order_acquire);
  const Join join;
  (*static_cast<const std::function<void(std::size_t)>*>(body))(i);
}

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  forks.fetch_add(1, std::memory_order_release);
  tbb_loop(count, run_body, &body);
  (void)joins.load(std::memory_order_acquire);
}

}  // namespace lemma
