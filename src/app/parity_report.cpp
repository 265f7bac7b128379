#include "src/app/parity_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "src/app/ray_file.h"

namespace lemma {
namespace {

using Json = nlohmann::ordered_json;

std::string row(std::string_view accel, std::string_view kind, const Tally& t) {
  std::string text = fmt::format("{:8}{:10}{:>10}{:>10}", accel, kind, t.rays, t.decided);
  for (const std::uint64_t count : t.ambiguous) text += fmt::format("{:>10}", count);
  return text +
         fmt::format("{:>8}{:>8}{:>10}{:>9.2g}\n", t.wrong, t.missed, t.wrong_occlusion, t.distance_error);
}

std::string head() {
  std::string text = fmt::format("{:8}{:10}{:>10}{:>10}", "accel", "rays", "asked", "decided");
  for (std::size_t i = 0; i < kDoubts; ++i) text += fmt::format("{:>10}", name_of(static_cast<Doubt>(i)));
  return text + fmt::format("{:>8}{:>8}{:>10}{:>9}\n", "wrong", "missed", "occlusion", "t error");
}

/// "triangle 7 at t 1.5", "nothing".
template <class AnyHit>
std::string describe(const std::optional<AnyHit>& hit) {
  return hit ? fmt::format("triangle {} at t {}", hit->triangle, hit->t) : "nothing";
}

/// "triangle 7 at t 1.5"; of a wrong occlusion also what the closest hit is, as the two may contradict.
std::string answer(const Fault& fault) {
  std::string hit = describe(fault.answer);
  if (fault.what != "occlusion") return hit;
  return fmt::format("{} (closest hit: {})", fault.occluded ? "blocked" : "not blocked", hit);
}

/// Commands for a shell that trace the ray of a fault again.
std::string replay(const ParityOptions& options, std::string_view accel, const Fault& fault) {
  std::string bytes;
  for (const char c : ray_bytes(fault.ray)) bytes += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return fmt::format("printf '{}' > ray.f32; lemma trace '{}' --accel {} --rays ray.f32 -o hit.bin{}", bytes,
                     options.scene.string(), accel, fault.what == "occlusion" ? " --any" : "");
}

Json to_json(const Tally& t) {
  Json ambiguous;
  for (std::size_t i = 0; i < kDoubts; ++i) ambiguous[name_of(static_cast<Doubt>(i))] = t.ambiguous[i];
  return {{"rays", t.rays},
          {"decided", t.decided},
          {"ambiguous", ambiguous},
          {"wrong", t.wrong},
          {"missed", t.missed},
          {"wrong_occlusion", t.wrong_occlusion},
          {"largest_t_error", t.distance_error}};
}

Json to_json(const ParityOptions& options, const Record& record) {
  Json kinds, faults = Json::array();
  for (std::size_t k = 0; k < kRayKinds; ++k) kinds[kRayKindNames[k]] = to_json(record.kinds[k]);
  for (const Fault& fault : record.first_faults) {
    faults.push_back({{"kind", kRayKindNames[static_cast<std::size_t>(fault.kind)]},
                      {"what", fault.what},
                      {"answer", answer(fault)},
                      {"truth", describe(fault.truth)},
                      {"replay", replay(options, record.name, fault)}});
  }
  return {{"accel", record.name}, {"total", to_json(record.total())}, {"kinds", kinds}, {"faults", faults}};
}

}  // namespace

bool is_foreign(std::string_view accelerator) {
  return accelerator == "embree";
}

std::string parity_text(const ParityOptions& options, std::span<const Record> records) {
  std::string text = head();
  for (const Record& record : records) {
    for (std::size_t k = 0; k < kRayKinds; ++k) text += row(record.name, kRayKindNames[k], record.kinds[k]);
    text += row(record.name, "all", record.total());
  }
  for (const Record& record : records) {
    for (const Fault& fault : record.first_faults) {
      text += fmt::format("{}: {} ({} ray): answers {}, the truth is {}\n  {}\n", record.name, fault.what,
                          kRayKindNames[static_cast<std::size_t>(fault.kind)], answer(fault),
                          describe(fault.truth), replay(options, record.name, fault));
    }
  }
  return text;
}

std::string parity_json(const ParityOptions& options, std::span<const Record> records) {
  Json json = {{"version", LEMMA_VERSION},
               {"scene", options.scene.string()},
               {"rays", options.rays},
               {"seed", options.seed},
               {"accelerators", Json::array()}};
  for (const Record& record : records) json["accelerators"].push_back(to_json(options, record));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may be no UTF-8
}

}  // namespace lemma
