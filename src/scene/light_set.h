#pragma once

#include <unordered_map>

#include "src/scene/read_xml.h"

namespace lemma {

/// Collects the lights of a file, each material once.
class LightSet {
 public:
  explicit LightSet(Warnings& warnings) : warnings_(warnings) {}

  /// Of two lights with the same material the later one counts, with a warning.
  void add(XmlLight light);

  [[nodiscard]] std::vector<XmlLight> take() { return std::move(lights_); }

 private:
  Warnings& warnings_;
  std::vector<XmlLight> lights_;
  std::unordered_map<std::string, std::size_t> index_;  // by material
};

}  // namespace lemma
