#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lemma {

/// A value that users choose by name. The tables of these are the only place where the names stand: parsing,
/// help and error messages are made from them.
template <class T>
struct Named {
  std::string_view name;
  T value;
  std::string_view help;
};

template <class T>
[[nodiscard]] std::optional<T> find_named(std::span<const Named<T>> table, std::string_view name) {
  for (const Named<T>& entry : table) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

/// The name of a value that the table holds.
template <class T>
[[nodiscard]] std::string_view name_of(std::span<const Named<T>> table, const T& value) {
  for (const Named<T>& entry : table) {
    if (entry.value == value) return entry.name;
  }
  return {};
}

/// "a, b, c": the accepted names, for messages.
template <class T>
[[nodiscard]] std::string list_names(std::span<const Named<T>> table) {
  std::string names;
  for (const Named<T>& entry : table) names.append(names.empty() ? "" : ", ").append(entry.name);
  return names;
}

}  // namespace lemma
