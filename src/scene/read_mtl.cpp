#include "src/scene/read_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"
#include "src/scene/texture_name.h"

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

/// Lines of one MTL file, put into materials. Not by a library: tinyobjloader reads "nan", "abc" and a
/// missing number as 0, says no line, and takes a Tr of three numbers for a dissolve.
class MtlReader {
 public:
  MtlReader(const std::filesystem::path& path, Warnings& warnings) : path_(path), warnings_(warnings) {}

  std::vector<MtlMaterial> read(std::string_view text) {
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
    if (line.keyword == "Ni") material.ni = read_index(line);
    if (line.keyword == "d") material.d = read_transparency(line, 1);
    if (line.keyword == "Tr") material.tr = read_transparency(line, 1);
    if (line.keyword == "illum") material.illum = read_transparency(line, 10);
    if (line.keyword == "map_Kd") {
      material.map_kd = texture_name(line.rest);
      material.map_kd_where = {path_, line.number};
    }
  }

  float read_index(const ObjLine& line) const {
    const double ni = read_numbers(line, 1).front();
    if (!(ni >= 0)) throw bad_line(line, "an index of refraction is not negative");
    return ni == 0 ? 1.0f : static_cast<float>(ni);  // some exporters write 0 for what is no glass
  }

  /// The numbers of a line on transparency, if they make sense: a file is not refused for what most of its
  /// materials carry without meaning it.
  std::vector<float> read_transparency(const ObjLine& line, double most) {
    constexpr std::string_view kHalo = "-halo ";  // of d: fades towards the rim; only its number counts here
    const std::string_view text = line.rest.starts_with(kHalo) ? line.rest.substr(kHalo.size()) : line.rest;
    const std::vector<double> numbers = parse_numbers(text).value_or(std::vector<double>{});
    const bool sound =
        (numbers.size() == 1 || numbers.size() == 3) &&
        std::all_of(numbers.begin(), numbers.end(), [&](double x) { return x >= 0 && x <= most; });
    if (sound) return {numbers.begin(), numbers.end()};
    warn(warnings_, {path_, line.number},
         fmt::format("{} is left out: one or three numbers from 0 to {} are needed",
                     in_quotes(fmt::format("{} {}", line.keyword, line.rest)), most));
    return {};
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
    return {{path_, line.number},
            fmt::format("{}: {}", in_quotes(fmt::format("{} {}", line.keyword, line.rest)), what),
            fmt::format("for example {} {}", line.keyword,
                        line.keyword.starts_with('K') ? "0.5 0.5 0.5" : "1.5")};
  }

  std::filesystem::path path_;
  Warnings& warnings_;
  std::vector<MtlMaterial> materials_;
  std::unordered_map<std::string, int> lines_;  // of each name's newmtl
};

}  // namespace

std::vector<MtlMaterial> parse_mtl(const std::filesystem::path& path, std::string_view text,
                                   Warnings& warnings) {
  return MtlReader(path, warnings).read(text);
}

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path, Warnings& warnings) {
  return parse_mtl(path, read_text_file(path, kMostDescriptionBytes, warnings), warnings);
}

}  // namespace lemma
