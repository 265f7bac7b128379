#include "src/app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace lemma {

std::span<const Named<ProgressStyle>> progress_styles() {
  static constexpr Named<ProgressStyle> styles[] = {
      {"auto", ProgressStyle::automatic, "a bar on a terminal, lines elsewhere"},
      {"bar", ProgressStyle::bar, "a bar that is drawn over and over"},
      {"plain", ProgressStyle::plain, "a line for every tenth"},
      {"off", ProgressStyle::off, "nothing"}};
  return styles;
}

Progress::Progress(ProgressStyle style) : style_(style) {
  if (style_ == ProgressStyle::automatic) {
    style_ = ::isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::plain;
  }
}

void Progress::update(double done) {
  if (style_ == ProgressStyle::bar) draw_bar(done);
  if (style_ == ProgressStyle::plain) print_line(done);
}

void Progress::draw_bar(double done) const {
  constexpr std::size_t width = 40;
  const auto filled = static_cast<std::size_t>(done * width);
  fmt::print(stderr, "\r[{}{}] {:3.0f} %  {}\x1b[K", std::string(filled, '='),
             std::string(width - filled, ' '), 100 * done, remaining(done));
  if (done >= 1) fmt::print(stderr, "\n");
  std::fflush(stderr);
}

void Progress::print_line(double done) {
  const int tenths = static_cast<int>(10 * done);
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  fmt::print(stderr, "{:3d} %  {}\n", 10 * tenths, remaining(done));
}

std::string Progress::remaining(double done) const {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (done >= 1) return fmt::format("{:.1f} s", elapsed);
  return fmt::format("{:.0f} s, {:.0f} s to go", elapsed, elapsed * (1 - done) / done);
}

}  // namespace lemma
