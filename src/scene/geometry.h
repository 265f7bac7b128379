#pragma once

#include "src/scene/light_list.h"
#include "src/scene/load_scene.h"
#include "src/scene/material_table.h"
#include "src/scene/read_obj.h"

namespace lemma {

/// Fills in triangles, facets, normals and emitters of `scene`, and whether it needs vertex normals; counts
/// in `report` what was read and dropped. Emitters carry the numbers of `lights`.
void build_geometry(const ObjFile& obj, const MaterialTable& materials, const LightList& lights, Scene& scene,
                    LoadReport& report);

}  // namespace lemma
