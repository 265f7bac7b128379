#pragma once

#include <vector>

#include "src/scene/read_obj.h"
#include "src/scene/read_xml.h"

namespace lemma {

/// Appends the spheres of a scene to its geometry as 1280 triangles each: an icosahedron, divided three
/// times, with the normals of the sphere, and as large as the sphere's area asks, so that a light sends what
/// the sphere would.
void add_spheres(const std::vector<XmlSphere>& spheres, ObjFile& obj);

}  // namespace lemma
