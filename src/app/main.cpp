#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "src/app/render_command.h"

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 bad scene, arguments or files; 2 done, but invalid samples were met and left out.";

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

/// One message for a command line that cannot be carried out, with the names that could have been meant.
int report_bad_arguments(const CLI::App& app, const CLI::ParseError& error) {
  fmt::print(stderr, "lemma: error: {}\n", error.what());
  const auto commands = app.get_subcommands();
  if (commands.empty()) {
    fmt::print(stderr, "  hint: expected a command: {}; lemma --help tells more\n", list_commands(app));
  } else if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    fmt::print(stderr, "  hint: the options of {} are: {}\n", commands.front()->get_name(),
               list_options(*commands.front()));
  }
  return lemma::kBadInput;
}

int run(int argc, char** argv) {
  CLI::App app("Lemma " LEMMA_VERSION ": a Monte Carlo renderer with swappable accelerators and estimators.",
               "lemma");
  app.set_version_flag("--version", "lemma " LEMMA_VERSION);
  app.set_help_all_flag("--help-all", "The help of all commands");
  app.require_subcommand(1);
  app.footer(kExitCodes);
  lemma::RenderOptions render_options;
  CLI::App* render = lemma::add_render_command(app, render_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return app.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    return report_bad_arguments(app, error);
  }
  return render->parsed() ? lemma::run_render(render_options) : lemma::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "lemma: error: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
  return lemma::kBadInput;
}
