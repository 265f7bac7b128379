#include "src/scene/texture_name.h"

#include <algorithm>
#include <array>

#include "src/scene/numbers.h"

namespace lemma {
namespace {

/// An option of a texture line, and how many words follow it. Source: the MTL specification, "Options for
/// texture map statements"; -colorspace is Autodesk's.
struct TextureOption {
  std::string_view name;
  int words;             // at most; numbers may be fewer
  bool numbers = false;  // the words are numbers: what is none is the name already
};
constexpr std::array<TextureOption, 13> kOptions{{{"-blendu", 1},
                                                  {"-blendv", 1},
                                                  {"-boost", 1, true},
                                                  {"-bm", 1, true},
                                                  {"-cc", 1},
                                                  {"-clamp", 1},
                                                  {"-colorspace", 1},
                                                  {"-imfchan", 1},
                                                  {"-mm", 2, true},
                                                  {"-o", 3, true},
                                                  {"-s", 3, true},
                                                  {"-t", 3, true},
                                                  {"-texres", 1, true}}};

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find_first_of(" \t"));
}

std::string_view without_first_word(std::string_view text) {
  text.remove_prefix(first_word(text).size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text;
}

bool is_number(std::string_view word) {
  const auto numbers = parse_numbers(word);
  return numbers && numbers->size() == 1;
}

const TextureOption* find_option(std::string_view word) {
  const auto found =
      std::find_if(kOptions.begin(), kOptions.end(), [&](const TextureOption& o) { return o.name == word; });
  return found == kOptions.end() ? nullptr : &*found;
}

}  // namespace

std::string texture_name(std::string_view line) {
  while (const TextureOption* option = find_option(first_word(line))) {
    line = without_first_word(line);
    for (int k = 0; k < option->words && !line.empty(); ++k) {
      if (option->numbers && !is_number(first_word(line))) break;
      line = without_first_word(line);
    }
  }
  return std::string(line);
}

}  // namespace lemma
