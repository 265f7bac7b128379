#pragma once

#include <cstddef>
#include <functional>

namespace lemma {

/// Runs at most this many threads in all parallel loops while it lives. The threads of the machine when 0.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

 private:
  struct Control;
  Control* control_;
  int threads_;
};

/// Calls body(i) once for each i in [0, count), in any order, on several threads; returns when all are done.
/// An exception of a body ends the loop and is thrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace lemma
