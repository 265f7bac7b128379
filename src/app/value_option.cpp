#include "src/app/value_option.h"

#include <fmt/format.h>

#include "src/app/argument_error.h"

namespace lemma {
namespace {

/// "-o,--output" -> "--output".
std::string long_name(const std::string& flag) {
  return flag.substr(flag.rfind(',') + 1);  // npos + 1 is 0
}

}  // namespace

CLI::Option* add_value(CLI::App& app, const ValueOption& option, const TakeValue& take) {
  const auto take_all = [name = long_name(option.flag), hint = "expected " + option.expected,
                         repeats = option.repeats, take](const CLI::results_t& texts) {
    if (texts.size() > 1 && !repeats) throw ArgumentError(name + ": given twice", "keep one of them");
    for (const std::string& text : texts) {
      if (text.empty()) throw ArgumentError(name + ": missing value", hint);
      if (!take(text)) throw ArgumentError(fmt::format("{}: invalid value \"{}\"", name, text), hint);
    }
    return true;
  };
  const std::string type = option.fallback.empty() ? option.type : option.type + "=" + option.fallback;
  return app.add_option(option.flag, take_all, option.help)
      ->type_name(type)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_file(CLI::App& app, const ValueOption& option,
                      const std::function<void(const std::filesystem::path&)>& take) {
  return add_value(app, option, [take](const std::string& text) {
    if (text.starts_with('-')) return false;  // an option, whose own value is missing
    take(text);
    return true;
  });
}

}  // namespace lemma
