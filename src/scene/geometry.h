#pragma once

#include "src/scene/light_list.h"
#include "src/scene/load_scene.h"
#include "src/scene/material_table.h"
#include "src/scene/read_obj.h"

namespace lemma {

/// Fills in triangles, facets, normals, texture coordinates and emitters of `scene`, and whether it needs
/// vertex normals; counts in `report` what was read and dropped. Emitters carry the numbers of `lights`.
/// Triangles that a material does not fit get a copy of it, which is appended to `materials`: without its
/// texture where they have no texture coordinates, and with `inside_out` where they are glass whose winding
/// opposes their vertex normals.
void build_geometry(const ObjFile& obj, const LightList& lights, MaterialTable& materials, Scene& scene,
                    LoadReport& report);

}  // namespace lemma
