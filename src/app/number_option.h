#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "src/app/value_option.h"

namespace lemma {

/// The whole text as a number; nothing if it is none.
template <class T>
[[nodiscard]] std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The whole text as a finite number above 0; nothing if it is none.
[[nodiscard]] inline std::optional<double> parse_positive(const std::string& text) {
  const auto number = parse_number<double>(text);
  return number && std::isfinite(*number) && *number > 0 ? number : std::nullopt;
}

/// Puts what `parse` makes of a text into `target`, if it makes anything of it.
template <class T, class Parse>
[[nodiscard]] TakeValue into(T& target, Parse parse) {
  return [&target, parse](const std::string& text) {
    const auto parsed = parse(text);
    if (parsed) target = *parsed;
    return parsed.has_value();
  };
}

/// Adds an option that takes a whole number in [lowest, highest].
template <class T>
void add_integer(CLI::App& app, const std::string& flag, T& value, std::type_identity_t<T> lowest,
                 std::type_identity_t<T> highest, const std::string& help) {
  const auto parse = [=](const std::string& text) {
    const std::optional<T> number = parse_number<T>(text);
    return number && *number >= lowest && *number <= highest ? number : std::nullopt;
  };
  add_value(app,
            {.flag = flag,
             .type = "N",
             .fallback = fmt::format("{}", value),
             .expected = fmt::format("a whole number from {} to {}", lowest, highest),
             .help = help},
            into(value, parse));
}

}  // namespace lemma
