#include "src/scene/read_mtl.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"

namespace lemma {
namespace {

constexpr double kMaxExponent = 1e6;

using ColourMember = Rgb MtlMaterial::*;
struct ColourKey {
  std::string_view keyword;
  ColourMember member;
};
constexpr std::array<ColourKey, 4> kColours{{
    {"Ka", &MtlMaterial::ka},
    {"Kd", &MtlMaterial::kd},
    {"Ks", &MtlMaterial::ks},
    {"Ke", &MtlMaterial::ke},
}};

/// The file name of a texture line. The library takes a name behind an option with optional numbers (-o 0.1
/// a.jpg) for one of those; then it is the last word.
std::string texture_name(const std::string& line) {
  std::string name;
  tinyobj::texture_option_t options{};
  if (tinyobj::ParseTextureNameAndOption(&name, &options, line.c_str())) return name;
  return line.substr(line.find_last_of(" \t") + 1);
}

/// Lines of one MTL file, put into materials. Not by tinyobj::LoadMtl: it reads "nan", "abc" and a missing
/// number as 0, says no line, and takes a Tr of three numbers for a dissolve.
class MtlReader {
 public:
  MtlReader(const std::filesystem::path& path, Warnings& warnings) : path_(path), warnings_(warnings) {}

  std::vector<MtlMaterial> read() {
    const std::string text = plain_lines(read_text_file(path_));
    LineCursor cursor(text);
    while (const std::optional<ObjLine> line = cursor.next()) {
      if (line->keyword == "newmtl") {
        start_material(*line);
      } else if (!materials_.empty()) {
        read_property(*line, materials_.back());
      }
    }
    return std::move(materials_);
  }

 private:
  void start_material(const ObjLine& line) {
    const auto [first, is_new] = lines_.try_emplace(std::string(line.rest), line.number);
    if (!is_new) {
      warn(warnings_, {path_, line.number},
           fmt::format("material {} is defined in line {} already; that one is used", in_quotes(line.rest),
                       first->second));
    }
    MtlMaterial& material = materials_.emplace_back();
    material.name = line.rest;
    material.where = {path_, line.number};
  }

  void read_property(const ObjLine& line, MtlMaterial& material) {
    for (const ColourKey& key : kColours) {
      if (line.keyword == key.keyword) material.*key.member = read_colour(line);
    }
    if (line.keyword == "Ns") material.ns = read_exponent(line);
    if (line.keyword == "Ni") material.ni = static_cast<float>(read_numbers(line, 1).front());
    if (line.keyword == "map_Kd") material.map_kd = texture_name(std::string(line.rest));
  }

  Rgb read_colour(const ObjLine& line) const {
    const std::vector<double> c = read_numbers(line, 3);
    if (*std::min_element(c.begin(), c.end()) < 0) throw bad_line(line, "no colour is negative");
    return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
  }

  float read_exponent(const ObjLine& line) {
    const double ns = read_numbers(line, 1).front();
    const double clamped = std::clamp(ns, 0.0, kMaxExponent);
    if (clamped != ns) {
      warn(warnings_, {path_, line.number},
           fmt::format("Ns {} is outside of [0, 1e6]: {} is used", ns, clamped));
    }
    return static_cast<float>(clamped);
  }

  /// @return count numbers that fit a float; one number stands for all of them
  std::vector<double> read_numbers(const ObjLine& line, std::size_t count) const {
    std::vector<double> numbers = parse_numbers(line.rest).value_or(std::vector<double>{});
    if (numbers.size() == 1) numbers.resize(count, numbers.front());
    if (numbers.size() < count)
      throw bad_line(line, count == 1 ? "a number is needed" : "three numbers are needed");
    for (const double x : numbers) {
      if (!(std::abs(x) <= std::numeric_limits<float>::max())) throw bad_line(line, "a number is not finite");
    }
    return numbers;
  }

  SceneError bad_line(const ObjLine& line, std::string_view what) const {
    const bool colour = line.keyword.starts_with('K');
    return {{path_, line.number},
            fmt::format("{}: {}", in_quotes(fmt::format("{} {}", line.keyword, line.rest)), what),
            fmt::format("for example {} {}", line.keyword, colour ? "0.5 0.5 0.5" : "1.5")};
  }

  std::filesystem::path path_;
  Warnings& warnings_;
  std::vector<MtlMaterial> materials_;
  std::unordered_map<std::string, int> lines_;  // of each name's newmtl
};

}  // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, Warnings& warnings) {
  return MtlReader(path, warnings).read();
}

}  // namespace lemma
