#pragma once

#include <cstddef>

#include <memory>

namespace lemma {

/// What Lemma uses of oneTBB, apart so that nothing else sees its headers.

/// Lets all loops use at most `threads` threads while it lives.
class TbbLimit {
 public:
  explicit TbbLimit(int threads);
  ~TbbLimit();
  TbbLimit(const TbbLimit&) = delete;
  TbbLimit& operator=(const TbbLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Threads that TBB would use without a limit.
[[nodiscard]] int tbb_threads();

/// call(argument, i) for i in [0, count) on the threads that the limit allows.
void tbb_loop(std::size_t count, void (*call)(const void* argument, std::size_t i), const void* argument);

}  // namespace lemma
