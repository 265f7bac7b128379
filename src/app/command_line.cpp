#include "src/app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "src/app/argument_error.h"
#include "src/app/check_command.h"
#include "src/app/compare_command.h"
#include "src/app/parity_command.h"
#include "src/app/render_command.h"
#include "src/app/trace_command.h"

namespace lemma {
namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 bad scene, arguments or files; 2 done, but invalid samples were met and left out; "
    "3 a "
    "comparison failed.";

bool is_option(const std::string& argument) {
  return argument.starts_with('-');
}

/// "--spp=16" -> "--spp".
std::string name_of(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

/// "--accel, --grid-cells, ...": every option of a command.
std::string list_options(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) names.append(names.empty() ? "" : ", ").append(option->get_name());
  }
  return names;
}

std::string list_commands(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.append(names.empty() ? "" : ", ").append(command->get_name());
  }
  return names;
}

std::string hint_at_commands(const CLI::App& app) {
  return fmt::format("expected one of: {}; lemma --help tells more", list_commands(app));
}

std::string hint_at_help(const CLI::App& command) {
  return fmt::format("lemma {} --help tells what it takes", command.get_name());
}

ArgumentError unknown_option(const CLI::App& command, const std::string& name) {
  if (command.get_option_no_throw(name) != nullptr) {
    return {fmt::format("{} stands before the command", name),
            fmt::format("the options of a command follow it: lemma {} ... {}", command.get_name(), name)};
  }
  return {fmt::format("unknown option \"{}\"", name), "expected one of: " + list_options(command)};
}

/// @param arguments  those that neither an option nor a command takes; not empty
ArgumentError unknown_argument(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto found = std::ranges::find_if(arguments, is_option);
  const std::string& argument = found == arguments.end() ? arguments.front() : *found;
  const auto commands = app.get_subcommands();
  if (commands.empty()) {
    return {fmt::format("unknown {} \"{}\"", is_option(argument) ? "option" : "command", argument),
            hint_at_commands(app)};
  }
  const CLI::App& command = *commands.front();
  if (is_option(argument)) return unknown_option(command, name_of(argument));
  return {fmt::format("unexpected argument \"{}\"", argument), hint_at_help(command)};
}

/// The option that an error is about, if the error is that the option has no value; else null. CLI11 tells
/// only in words which one it is.
CLI::Option* find_option_without_value(CLI::App& command, const CLI::ParseError& error,
                                       const std::string& last_argument) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    return command.get_option_no_throw(name_of(last_argument));
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr) return nullptr;
  const auto missing = command.get_options(
      [](const CLI::Option* option) { return option->get_required() && option->count() == 0; });
  return missing.empty() ? nullptr : missing.front();
}

/// Throws an error in Lemma's words: those of CLI11 differ from version to version and do not tell what is
/// accepted.
[[noreturn]] void refuse(CLI::App& app, const CLI::ParseError& error, const std::string& last_argument) {
  if (const auto unknown = app.remaining(true); !unknown.empty()) throw unknown_argument(app, unknown);
  const auto commands = app.get_subcommands();
  if (commands.empty()) throw ArgumentError("no command", hint_at_commands(app));
  CLI::App& command = *commands.front();
  if (CLI::Option* option = find_option_without_value(command, error, last_argument)) {
    option->clear();
    option->add_result("");
    option->run_callback();  // refuses the empty value and says what is expected
  }
  throw ArgumentError(error.what(), hint_at_help(command));
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  CLI::App app("Lemma " LEMMA_VERSION ": a Monte Carlo renderer with swappable accelerators and estimators.",
               "lemma");
  app.set_version_flag("--version", "lemma " LEMMA_VERSION);
  app.set_help_all_flag("--help-all", "The help of all commands");
  app.require_subcommand(1);
  app.footer(kExitCodes);
  RenderOptions render_options;
  const CLI::App* render = add_render_command(app, render_options);
  TraceOptions trace_options;
  const CLI::App* trace = add_trace_command(app, trace_options);
  ParityOptions parity_options;
  const CLI::App* parity = add_parity_command(app, parity_options);
  CheckOptions check_options;
  const CLI::App* check = add_check_command(app, check_options);
  CompareOptions compare_options;
  const CLI::App* compare = add_compare_command(app, compare_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return app.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    refuse(app, error, argv[argc - 1]);
  }
  if (trace->parsed()) return run_trace(trace_options);
  if (parity->parsed()) return run_parity(parity_options);
  if (check->parsed()) return run_check(check_options);
  if (compare->parsed()) return run_compare(compare_options);
  return render->parsed() ? run_render(render_options) : kBadInput;
}

}  // namespace lemma
