#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <type_traits>

#include "src/core/named.h"

namespace lemma {

/// How an option that takes a value presents itself.
struct ValueOption {
  std::string flag;           // "-o,--output"; without dashes it is an argument that is known by its place
  std::string type;           // what help calls the value
  std::string fallback = {};  // what holds if no value is given, for help; empty: nothing does
  std::string expected;       // what errors say is accepted
  std::string help;
  bool repeats = false;  // may be given several times
};

/// Takes a value's text; false if it is not accepted.
using TakeValue = std::function<bool(const std::string& text)>;

/// Adds an option whose values go to `take`. A value that is refused, missing, or given twice is an
/// ArgumentError.
CLI::Option* add_value(CLI::App& app, const ValueOption& option, const TakeValue& take);

/// Adds an option that takes a file's name.
CLI::Option* add_file(CLI::App& app, const ValueOption& option,
                      const std::function<void(const std::filesystem::path&)>& take);

/// Adds an option whose value is a name of the table: help and errors list the names, and the first is the
/// default.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::span<const Named<T>> table,
                        std::type_identity_t<std::function<void(const Named<T>&)>> choose,
                        const std::string& help) {
  std::string description = help + ":";
  for (const Named<T>& entry : table) {
    description.append("\n  ").append(entry.name).append(": ").append(entry.help);
  }
  const auto take = [table, choose = std::move(choose)](const std::string& name) {
    for (const Named<T>& entry : table) {
      if (entry.name != name) continue;
      choose(entry);
      return true;
    }
    return false;
  };
  return add_value(app,
                   {.flag = flag,
                    .type = "NAME",
                    .fallback = std::string(table.front().name),
                    .expected = "one of: " + list_names(table),
                    .help = description},
                   take);
}

}  // namespace lemma
