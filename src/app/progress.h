#pragma once

#include <chrono>
#include <span>

#include "src/app/options.h"

namespace lemma {

/// The styles by the name users give them.
[[nodiscard]] std::span<const Named<ProgressStyle>> progress_styles();

/// Shows on stderr how far a long task is, with the time it will still take.
class Progress {
 public:
  explicit Progress(ProgressStyle style);

  /// @param done  part done, in [0, 1]
  void update(double done);

 private:
  void draw_bar(double done) const;
  void print_line(double done);
  [[nodiscard]] std::string remaining(double done) const;

  ProgressStyle style_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  int tenths_ = 0;  // lines printed so far
};

}  // namespace lemma
