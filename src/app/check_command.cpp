#include "src/app/check_command.h"

#include <fmt/format.h>

#include "src/app/check_report.h"
#include "src/app/value_option.h"
#include "src/render/whole_file.h"

namespace lemma {

CLI::App* add_check_command(CLI::App& app, CheckOptions& o) {
  CLI::App* check =
      app.add_subcommand("check", "What a scene holds, needs and costs, and what is wrong with it");
  add_scene_options(*check, o.scene);
  add_file(*check,
           {.flag = "--json", .type = "FILE.json", .expected = "a file's name", .help = "Write all as JSON"},
           [&o](const auto& path) { o.json = path; });
  check->add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
  return check;
}

ExitCode run_check(const CheckOptions& options) {
  if (!options.json.empty()) check_whole_file(options.json);
  const SceneCheck check = check_scene(options.scene.scene, options.scene.load);
  const auto costs = check.error ? std::vector<AcceleratorCost>{} : measure_costs(check.loaded.scene);
  if (!options.json.empty()) write_whole_file(options.json, check_json(check, costs));
  const bool found = !check.loaded.report.obj.empty();
  if (!options.quiet && found) fmt::print("{}", check_text(check, costs));
  if (check.error) fmt::print(stderr, "{}\n", *check.error);
  if (check.error) return kBadInput;
  if (options.scene.strict) report_warnings(check.loaded.report.warnings, true);
  return kDone;
}

}  // namespace lemma
