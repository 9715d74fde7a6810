// The normals to draw the solid's surface with.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

/// One unit normal for each corner of each triangle: the mean, by angle, over the triangles around the vertex
/// that can be reached without crossing an edge of 30 degrees or more. Boxes stay sharp, balls get smooth.
std::vector<std::array<Eigen::Vector3d, 3>> cornerNormals(const CheckedMesh& mesh);

}  // namespace rubble::cooking
