#include "src/app/ray_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "src/core/machine.h"

namespace lemma {
namespace {

using RayRecord = std::array<float, 8>;
constexpr std::size_t kRayBytes = sizeof(RayRecord);
static_assert(kRayBytes == 32 && std::endian::native == std::endian::little);

struct HitRecord {
  std::int32_t triangle;
  float t, b1, b2;
};
static_assert(sizeof(HitRecord) == 16);

std::runtime_error bad_file(const std::filesystem::path& path, std::string_view what, std::string_view hint) {
  return std::runtime_error(fmt::format("{}: error: {}\n  hint: {}", path.string(), what, hint));
}

constexpr const char* kRayFormat = "rays are 8 float32 each: ox oy oz tmin dx dy dz tmax";

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw bad_file(path, "no such file", "check the name");
  if (std::filesystem::is_directory(path, error)) throw bad_file(path, "this is a folder", "name a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw bad_file(path, "the file cannot be opened", "check its permissions");
  if (const auto size = std::filesystem::file_size(path, error); !error && size > machine_memory() / 4) {
    throw bad_file(
        path,
        fmt::format("the file has {:.1f} GB, too much for this machine", static_cast<double>(size) / 1e9),
        "divide it");
  }
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad()) throw bad_file(path, "the file cannot be read to its end", "check the disk");
  return std::move(content).str();
}

template <class Record>
std::string bytes_of(const Record& record) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(Record)>>(record);
  return {bytes.data(), bytes.size()};
}

}  // namespace

std::vector<Ray> read_rays(const std::filesystem::path& path) {
  return parse_rays(path, read_bytes(path));
}

std::vector<Ray> parse_rays(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.empty()) throw bad_file(path, "the file is empty", kRayFormat);
  if (bytes.size() % kRayBytes != 0) {
    throw bad_file(path, fmt::format("{} bytes are no whole number of rays of {}", bytes.size(), kRayBytes),
                   kRayFormat);
  }
  std::vector<Ray> rays;
  rays.reserve(bytes.size() / kRayBytes);
  for (std::size_t at = 0; at < bytes.size(); at += kRayBytes) {
    RayRecord r{};
    std::memcpy(r.data(), bytes.data() + at, kRayBytes);
    rays.push_back({{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, r[3], r[7]});
  }
  return rays;
}

std::string ray_bytes(const Ray& ray) {
  const auto& [o, d, t_min, t_max] = ray;
  return bytes_of(RayRecord{o.x, o.y, o.z, t_min, d.x, d.y, d.z, t_max});
}

std::string hit_bytes(std::span<const std::optional<Hit>> hits) {
  std::string bytes;
  bytes.reserve(hits.size() * sizeof(HitRecord));
  for (const std::optional<Hit>& hit : hits) {
    bytes += bytes_of(hit ? HitRecord{static_cast<std::int32_t>(hit->triangle), hit->t, hit->b1, hit->b2}
                          : HitRecord{-1, 0, 0, 0});
  }
  return bytes;
}

}  // namespace lemma
