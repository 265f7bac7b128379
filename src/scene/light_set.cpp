#include "src/scene/light_set.h"

#include <fmt/format.h>

namespace lemma {

void LightSet::add(XmlLight light) {
  const auto [entry, is_new] = index_.try_emplace(light.material, lights_.size());
  if (is_new) {
    lights_.push_back(std::move(light));
    return;
  }
  XmlLight& same = lights_[entry->second];
  warn(warnings_, light.where,
       fmt::format("light {} is given in line {} already; this one is used", in_quotes(light.material),
                   same.where.line));
  same = std::move(light);
}

}  // namespace lemma
