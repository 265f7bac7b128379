#include "src/scene/read_obj.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <unordered_map>

#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"

namespace lemma {
namespace {

/// Something the file has that is left out: where first, and how often.
struct Finding {
  int line = 0;
  std::size_t count = 0;

  void add(int at) {
    if (count++ == 0) line = at;
  }
};

/// Indices of vertices, normals and triangles are 32-bit numbers, of which the last means "none".
constexpr std::size_t kMostElements = 0xFFFFFFFEu;

enum class Field { number, not_finite, malformed };

/// tinyobjloader reads whatever is no number as 0, and the rest of "1.2.3" not at all, without a word; so
/// each field is looked at first.
Field classify(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const char* const end = field.data() + field.size();
  double value = 0;  // stays 0 for 1e999 and 1e-999, which the library takes for infinity and 0
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (stop == end && error != std::errc::invalid_argument) {
    return std::isfinite(value) ? Field::number : Field::not_finite;
  }
  return field.find("1.#") != field.npos ? Field::not_finite : Field::malformed;  // MSVC's -1.#IND, 1.#INF
}

/// Of the first three fields the worst; malformed if there are fewer.
Field classify_three(std::string_view fields) {
  Field worst = Field::number;
  for (int k = 0; k < 3; ++k) {
    const std::size_t length = std::min(fields.find_first_of(" \t"), fields.size());
    worst = std::max(worst, classify(fields.substr(0, length)));
    fields.remove_prefix(length);
    fields.remove_prefix(std::min(fields.find_first_not_of(" \t"), fields.size()));
  }
  return worst;
}

/// Whether each index of a face is a whole number other than 0 that fits an int: atoi, by which tinyobjloader
/// reads them, cannot tell.
bool indices_are_sound(std::string_view fields) {
  constexpr std::string_view kSeparators = " \t/";
  const char* at = fields.data();
  const char* const end = at + fields.size();
  while (at != end) {
    if (kSeparators.find(*at) != kSeparators.npos) {
      ++at;
      continue;
    }
    int index = 0;
    const auto [next, error] = std::from_chars(at, end, index);
    if (error != std::errc() || index == 0) return false;
    if (next != end && kSeparators.find(*next) == kSeparators.npos) return false;
    at = next;
  }
  return true;
}

/// Takes what tinyobjloader calls back with. The library gives no positions, and has changed which names and
/// numbers it accepts from version to version; so a cursor follows it from line to line, and each line is
/// checked here.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, Warnings& warnings)
      : path_(path), warnings_(warnings), text_(plain_lines(read_text_file(path))), cursor_(text_) {}

  ObjFile read() {
    find_libraries();
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, float x, float y, float z, float) {
      of(self).add_vertex({x, y, z});
    };
    callbacks.normal_cb = [](void* self, float x, float y, float z) { of(self).add_normal({x, y, z}); };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int n) { of(self).add_face(corners, n); };
    callbacks.usemtl_cb = [](void* self, const char*, int) { of(self).use_material(); };
    std::istringstream stream(text_);
    std::string library_warnings, error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, this, nullptr, &library_warnings, &error)) {
      throw SceneError({path_}, fmt::format("the OBJ reader gives up: {}", in_quotes(error)), "");
    }
    report_findings();
    return std::move(file_);
  }

 private:
  static ObjReader& of(void* self) { return *static_cast<ObjReader*>(self); }

  void find_libraries() {
    LineCursor cursor(text_);
    while (const std::optional<ObjLine> line = cursor.next()) {
      if (line->keyword == "mtllib" && !line->rest.empty()) {
        file_.libraries.push_back({std::string(line->rest), {path_, line->number}});
      }
    }
  }

  /// The line that the library just read: the next one with this keyword and something behind it.
  ObjLine line_of(std::string_view keyword) {
    while (const std::optional<ObjLine> line = cursor_.next()) {
      if (line->keyword == keyword && !line->rest.empty()) return *line;
    }
    throw SceneError({path_}, "the OBJ reader and its line counter disagree", "");
  }

  Vec3 checked(const Vec3& read, const ObjLine& line) const {
    const Field field = classify_three(line.rest);
    if (field == Field::malformed) {
      throw SceneError({path_, line.number},
                       fmt::format("{} is not \"{}\" and three numbers",
                                   in_quotes(fmt::format("{} {}", line.keyword, line.rest)), line.keyword),
                       fmt::format("for example {} 0.5 1 -2e-3", line.keyword));
    }
    return field == Field::number ? read : Vec3(std::numeric_limits<float>::quiet_NaN());
  }

  void add_vertex(const Vec3& read) {
    const ObjLine line = line_of("v");
    const Vec3 vertex = checked(read, line);
    if (!is_finite(vertex) || max_norm(vertex) > kMaxCoordinate) bad_vertices_.add(line.number);
    file_.vertices.push_back(vertex);
  }

  void add_normal(const Vec3& read) { file_.normals.push_back(checked(read, line_of("vn"))); }

  void add_face(const tinyobj::index_t* corners, int n) {
    const ObjLine line = line_of("f");
    if (!indices_are_sound(line.rest)) {
      throw SceneError(
          {path_, line.number}, fmt::format("{} is no face", in_quotes(fmt::format("f {}", line.rest))),
          "corners are written 1, 1/2, 1//3 or 1/2/3; no index is 0; -1 is the last vertex so far");
    }
    if (n < 3) return short_faces_.add(line.number);
    const std::size_t triangles = file_.triangles.size() + static_cast<std::size_t>(n);
    if (std::max({triangles, file_.vertices.size(), file_.normals.size()}) > kMostElements) {
      throw SceneError({path_, line.number}, "the file has more than 2^32 - 2 elements", "divide it");
    }
    if (!material_) material_ = material_index({"", {path_, line.number}});
    ObjTriangle fan{.material = *material_};
    set_corner(fan, 0, corners[0], line.number);
    set_corner(fan, 2, corners[1], line.number);
    for (int k = 2; k < n; ++k) {
      fan.vertex[1] = fan.vertex[2];
      fan.normal[1] = fan.normal[2];
      set_corner(fan, 2, corners[k], line.number);
      file_.triangles.push_back(fan);
    }
  }

  void set_corner(ObjTriangle& t, std::size_t slot, const tinyobj::index_t& corner, int line) const {
    t.vertex[slot] = resolve(corner.vertex_index, file_.vertices.size(), "vertex", line);
    t.normal[slot] = corner.normal_index == 0
                         ? kNoNormal
                         : resolve(corner.normal_index, file_.normals.size(), "normal", line);
  }

  /// The 0-based index for one of the file: 1 is the first, -1 the last so far.
  std::uint32_t resolve(int index, std::size_t count, std::string_view what, int line) const {
    const auto n = static_cast<std::int64_t>(count);
    const std::int64_t at = index > 0 ? std::int64_t{index} - 1 : n + index;
    if (at < 0 || at >= n) {
      throw SceneError({path_, line},
                       fmt::format("a face uses {} {}, but {} {} defined before it", what, index, count,
                                   count == 1 ? "is" : "are"),
                       "indices count from 1; negative ones count back from the last one defined, -1");
    }
    return static_cast<std::uint32_t>(at);
  }

  void use_material() {
    const ObjLine line = line_of("usemtl");
    material_ = material_index({std::string(line.rest), {path_, line.number}});
  }

  std::uint32_t material_index(const ObjName& name) {
    const auto [entry, is_new] =
        material_indices_.try_emplace(name.name, static_cast<std::uint32_t>(file_.materials.size()));
    if (is_new) file_.materials.push_back(name);
    return entry->second;
  }

  void report_findings() {
    if (bad_vertices_.count > 0) {
      warn(
          warnings_, {path_, bad_vertices_.line},
          fmt::format("a vertex is not finite or beyond 1e18 ({} in all); triangles that use one are dropped",
                      bad_vertices_.count));
    }
    if (short_faces_.count > 0) {
      warn(
          warnings_, {path_, short_faces_.line},
          fmt::format("a face has fewer than three corners ({} in all) and is left out", short_faces_.count));
    }
  }

  std::filesystem::path path_;
  Warnings& warnings_;
  std::string text_;
  LineCursor cursor_;
  ObjFile file_;
  std::unordered_map<std::string, std::uint32_t> material_indices_;
  std::optional<std::uint32_t> material_;  // of the faces that follow
  Finding bad_vertices_, short_faces_;
};

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, Warnings& warnings) {
  return ObjReader(path, warnings).read();
}

}  // namespace lemma
