#pragma once

#include <cstddef>
#include <functional>

#include "src/core/tbb_loop.h"

namespace lemma {

/// Runs at most this many threads in all parallel loops while it lives. The threads of the machine when 0.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : threads_(threads > 0 ? threads : tbb_threads()), limit_(threads_) {}

  [[nodiscard]] int threads() const { return threads_; }

 private:
  int threads_;
  TbbLimit limit_;
};

/// Calls body(i) once for each i in [0, count), in any order, on several threads; returns when all are done.
/// An exception of a body ends the loop and is thrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace lemma
