// Pore springs and anchors from the clipped cells: paper 3.1.1, step 6.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cook/checked_mesh.h"
#include "cook/restricted_voronoi.h"
#include "cook/site_pieces.h"

namespace rubble::cooking {

/// DEVIATION: the paper puts a spring on every Delaunay edge. Even in a box one edge in ten has its Voronoi
/// face outside, and across a slot such edges tie the sides together; so a spring needs a shared clipped face
/// of `leastArea` [m^2]. Elements that would then hang on nothing although the solid goes on, as in a
/// leg or a sheet much thinner than a spacing, get springs at smaller faces too.
std::vector<AssetSpring> findSprings(const RestrictedVoronoi& diagram, const SitePieces& pieces,
                                     double leastArea);

/// The part of each cell's outer faces that points along `direction` and lies within `band` [m] of the
/// solid's furthest point in it. `direction` need not be of unit length.
std::vector<AssetAnchor> findAnchors(const CheckedMesh& mesh, const RestrictedVoronoi& diagram,
                                     const SitePieces& pieces, const Eigen::Vector3d& direction, double band);

}  // namespace rubble::cooking
