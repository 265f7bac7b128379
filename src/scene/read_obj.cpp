#include "src/scene/read_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <unordered_map>

#include "src/core/machine.h"
#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"

namespace lemma {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Something the file has that is left out: where first, and how often.
struct Finding {
  int line = 0;
  std::size_t count = 0;

  void add(int at) {
    if (count++ == 0) line = at;
  }
};

/// Indices of vertices, normals and triangles are 32-bit numbers, of which the last means "none".
constexpr std::uint64_t kMostElements = 0xFFFFFFFEu;

/// Cuts the first field off a line's rest.
std::string_view take_field(std::string_view& rest) {
  std::size_t length = 0;
  while (length < rest.size() && rest[length] != ' ' && rest[length] != '\t') ++length;
  const std::string_view field = rest.substr(0, length);
  while (length < rest.size() && (rest[length] == ' ' || rest[length] == '\t')) ++length;
  rest.remove_prefix(length);
  return field;
}

/// A number that no float holds: 1e999 is infinite, 1e-999 is 0.
float beyond_float(std::string_view field) {
  const double value = std::strtod(std::string(field).c_str(), nullptr);
  return std::abs(value) > 1 ? kNan : 0.0f;
}

/// The whole field as a number; NaN for what is not finite, among it MSVC's -1.#IND and 1.#INF; nothing if it
/// is no number.
std::optional<float> parse_float(std::string_view field) {
  std::string_view digits = field;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  float value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (stop == end && error == std::errc()) return value;
  if (stop == end && error == std::errc::result_out_of_range) return beyond_float(digits);
  return digits.find("1.#") != digits.npos ? std::optional(kNan) : std::nullopt;
}

/// Indices of one corner as written: 1 is the first, -1 the last so far, 0 stands for none.
struct Corner {
  int vertex = 0, texcoord = 0, normal = 0;
};

/// Takes a whole number other than 0.
std::optional<int> take_index(const char*& at, const char* end) {
  int index = 0;
  const auto [stop, error] = std::from_chars(at, end, index);
  if (error != std::errc() || index == 0) return std::nullopt;
  at = stop;
  return index;
}

/// "1", "1/2", "1//3", "1/2/3"; the numbers behind a slash may be missing.
std::optional<Corner> parse_corner(std::string_view field) {
  Corner corner;
  const char* at = field.data();
  const char* const end = at + field.size();
  int* const slots[] = {&corner.vertex, &corner.texcoord, &corner.normal};
  for (std::size_t slot = 0; slot < std::size(slots); ++slot) {
    if (slot > 0) {
      if (at == end) return corner;
      if (*at++ != '/') return std::nullopt;
    }
    if (slot > 0 && (at == end || *at == '/')) continue;
    const std::optional<int> index = take_index(at, end);
    if (!index) return std::nullopt;
    *slots[slot] = *index;
  }
  return at == end ? std::optional(corner) : std::nullopt;
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text, Warnings& warnings,
            const ObjLimits& limits)
      : path_(path), text_(text), warnings_(warnings), limits_(limits) {}

  ObjFile read() {
    reserve();
    LineCursor cursor(text_);
    while (const std::optional<ObjLine> line = cursor.next()) read_line(*line);
    report_findings();
    return std::move(file_);
  }

 private:
  /// Takes the memory that the lines need at once: a vector that grows holds everything twice for a while.
  void reserve() {
    std::size_t vertices = 0, normals = 0, texcoords = 0, faces = 0;
    for (std::size_t at = 0; at + 2 < text_.size();) {
      if (text_[at] == 'v') {
        vertices += text_[at + 1] == ' ' ? 1 : 0;
        normals += text_[at + 1] == 'n' ? 1 : 0;
        texcoords += text_[at + 1] == 't' ? 1 : 0;
      }
      faces += text_[at] == 'f' ? 1 : 0;
      const std::size_t end = text_.find('\n', at);
      if (end == text_.npos) break;
      at = end + 1;
    }
    file_.vertices.reserve(vertices);
    file_.normals.reserve(normals);
    file_.texcoords.reserve(texcoords);
    file_.triangles.reserve(std::min<std::uint64_t>(faces, limits_.triangles));
  }

  void read_line(const ObjLine& line) {
    if (line.keyword == "v") {
      add_vertex(line);
    } else if (line.keyword == "vn") {
      file_.normals.push_back(read_three(line));
    } else if (line.keyword == "vt") {
      add_texcoord(line);
    } else if (line.keyword == "f") {
      add_face(line);
    } else if (line.keyword == "usemtl" && !line.rest.empty()) {
      material_ = material_index({std::string(line.rest), {path_, line.number}});
    } else if (line.keyword == "mtllib" && !line.rest.empty()) {
      file_.libraries.push_back({std::string(line.rest), {path_, line.number}});
    }
  }

  Vec3 read_three(const ObjLine& line) const {
    Vec3 three;
    std::string_view rest = line.rest;
    for (int k = 0; k < 3; ++k) {
      const std::optional<float> number = parse_float(take_field(rest));
      if (!number) {
        throw SceneError({path_, line.number},
                         fmt::format("{} is not \"{}\" and three numbers",
                                     in_quotes(fmt::format("{} {}", line.keyword, line.rest)), line.keyword),
                         fmt::format("for example {} 0.5 1 -2e-3", line.keyword));
      }
      three[k] = *number;
    }
    return is_finite(three) ? three : Vec3(kNan);
  }

  void add_vertex(const ObjLine& line) {
    const Vec3 vertex = read_three(line);
    if (!is_finite(vertex) || max_norm(vertex) > kMaxCoordinate) bad_vertices_.add(line.number);
    file_.vertices.push_back(vertex);
  }

  /// u, and v, which may be missing; a texture that cannot be placed is no reason to refuse a file.
  void add_texcoord(const ObjLine& line) {
    std::string_view rest = line.rest;
    const float u = parse_float(take_field(rest)).value_or(kNan);
    const std::string_view second = take_field(rest);
    const float v = second.empty() ? 0.0f : parse_float(second).value_or(kNan);
    const bool finite = std::isfinite(u) && std::isfinite(v);
    if (!finite) bad_texcoords_.add(line.number);
    file_.texcoords.push_back(finite ? Vec2(u, v) : Vec2(kNan));
  }

  void add_face(const ObjLine& line) {
    corners_.clear();
    for (std::string_view rest = line.rest; !rest.empty();) {
      const std::optional<Corner> corner = parse_corner(take_field(rest));
      if (!corner) {
        throw SceneError(
            {path_, line.number}, fmt::format("{} is no face", in_quotes(fmt::format("f {}", line.rest))),
            "corners are written 1, 1/2, 1//3 or 1/2/3; no index is 0; -1 is the last vertex so far");
      }
      corners_.push_back(*corner);
    }
    if (corners_.size() < 3) return short_faces_.add(line.number);
    require_room(line.number);
    if (!material_) material_ = material_index({"", {path_, line.number}});
    ObjTriangle fan{.material = *material_};
    set_corner(fan, 0, corners_[0], line.number);
    set_corner(fan, 2, corners_[1], line.number);
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      fan.vertex[1] = fan.vertex[2];
      fan.normal[1] = fan.normal[2];
      fan.texcoord[1] = fan.texcoord[2];
      set_corner(fan, 2, corners_[k], line.number);
      file_.triangles.push_back(fan);
    }
  }

  void require_room(int line) const {
    const std::size_t vectors =
        std::max({file_.vertices.size(), file_.normals.size(), file_.texcoords.size()});
    if (file_.triangles.size() + corners_.size() - 2 <= limits_.triangles && vectors <= kMostElements) return;
    throw SceneError(
        {path_, line},
        fmt::format("the file has more than {} triangles, the most that are read here", limits_.triangles),
        "divide it, or use a machine with more memory");
  }

  void set_corner(ObjTriangle& t, std::size_t slot, const Corner& corner, int line) {
    t.vertex[slot] = vertex_index(corner.vertex, line);
    t.normal[slot] = find_or_note(corner.normal, file_.normals.size(), undefined_normals_, line);
    t.texcoord[slot] = find_or_note(corner.texcoord, file_.texcoords.size(), undefined_texcoords_, line);
  }

  /// The 0-based index for one of the file; nothing if there is no such element yet.
  static std::optional<std::uint32_t> find_index(int index, std::size_t count) {
    const auto n = static_cast<std::int64_t>(count);
    const std::int64_t at = index > 0 ? std::int64_t{index} - 1 : n + index;
    if (index == 0 || at < 0 || at >= n) return std::nullopt;
    return static_cast<std::uint32_t>(at);
  }

  /// A triangle does without normals or texture coordinates that are not defined.
  static std::uint32_t find_or_note(int index, std::size_t count, Finding& undefined, int line) {
    const std::optional<std::uint32_t> at = find_index(index, count);
    if (index != 0 && !at) undefined.add(line);
    return at.value_or(kNoIndex);
  }

  std::uint32_t vertex_index(int index, int line) const {
    const std::size_t count = file_.vertices.size();
    const std::optional<std::uint32_t> at = find_index(index, count);
    if (!at) {
      throw SceneError({path_, line},
                       fmt::format("a face uses vertex {}, but {} {} defined before it", index, count,
                                   count == 1 ? "is" : "are"),
                       "indices count from 1; negative ones count back from the last one defined, -1");
    }
    return *at;
  }

  std::uint32_t material_index(const ObjName& name) {
    const auto [entry, is_new] =
        material_indices_.try_emplace(name.name, static_cast<std::uint32_t>(file_.materials.size()));
    if (is_new) file_.materials.push_back(name);
    return entry->second;
  }

  void report(const Finding& finding, std::string_view what, std::string_view consequence) {
    if (finding.count == 0) return;
    warn(warnings_, {path_, finding.line}, fmt::format("{} ({} in all){}", what, finding.count, consequence));
  }

  void report_findings() {
    report(bad_vertices_, "a vertex is not finite or beyond 1e18", "; triangles that use one are dropped");
    report(bad_texcoords_, "a texture coordinate is no finite number",
           "; triangles that use one have no texture");
    report(undefined_normals_, "a face uses a normal that is not defined before it",
           "; the corner has the normal of its triangle");
    report(undefined_texcoords_, "a face uses a texture coordinate that is not defined before it",
           "; its triangles have no texture");
    report(short_faces_, "a face has fewer than three corners", " and is left out");
  }

  std::filesystem::path path_;
  std::string_view text_;
  Warnings& warnings_;
  ObjLimits limits_;
  ObjFile file_;
  std::unordered_map<std::string, std::uint32_t> material_indices_;
  std::vector<Corner> corners_;            // of the face that is read
  std::optional<std::uint32_t> material_;  // of the faces that follow
  Finding bad_vertices_, bad_texcoords_, undefined_normals_, undefined_texcoords_, short_faces_;
};

/// What a triangle takes in loading at its peak, measured on a million triangles with normals and texture
/// coordinates of their own, and rounded up; and what may be taken of the machine.
constexpr std::uint64_t kBytesATriangle = 400;
constexpr std::uint64_t kMemoryShare = 2;

}  // namespace

ObjLimits ObjLimits::of_machine() {
  const std::uint64_t memory = machine_memory() / kMemoryShare;
  return {.bytes = memory, .triangles = std::min(memory / kBytesATriangle, kMostElements)};
}

ObjFile parse_obj(const std::filesystem::path& path, std::string_view text, Warnings& warnings,
                  const ObjLimits& limits) {
  return ObjReader(path, text, warnings, limits).read();
}

ObjFile read_obj(const std::filesystem::path& path, Warnings& warnings, const ObjLimits& limits) {
  return parse_obj(path, read_text_file(path, limits.bytes, warnings), warnings, limits);
}

}  // namespace lemma
