#pragma once

#include <string>
#include <vector>

#include "src/app/accelerator_cost.h"
#include "src/scene/check_scene.h"

namespace lemma {

/// For people: a few blocks of lines.
[[nodiscard]] std::string check_text(const SceneCheck& check, const std::vector<AcceleratorCost>& costs);

/// For programs: a JSON object.
[[nodiscard]] std::string check_json(const SceneCheck& check, const std::vector<AcceleratorCost>& costs);

}  // namespace lemma
