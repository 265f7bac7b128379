#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <type_traits>

#include "src/core/named.h"

namespace lemma {

/// Adds an option whose value is a name of the table: help lists the names, a wrong one is an error that
/// lists them, and the first is the default.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::span<const Named<T>> table,
                        std::type_identity_t<std::function<void(const Named<T>&)>> choose,
                        const std::string& help) {
  std::string description = help + ":";
  for (const Named<T>& entry : table) {
    description.append("\n  ").append(entry.name).append(": ").append(entry.help);
  }
  const auto read = [table, flag, choose = std::move(choose)](const std::string& name) {
    for (const Named<T>& entry : table) {
      if (entry.name != name) continue;
      choose(entry);
      return;
    }
    throw CLI::ValidationError(
        flag, "unknown value \"" + name + "\"\n  hint: expected one of: " + list_names(table));
  };
  return app.add_option_function<std::string>(flag, read, description)
      ->type_name("NAME")
      ->default_str(std::string(table.front().name));
}

}  // namespace lemma
