// Pore springs and anchors from the clipped cells: paper 3.1.1, step 6.
#pragma once

#include <Eigen/Geometry>
#include <optional>
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

/// What is to be tied, in the frame of the diagram.
struct AnchorWish {
  std::optional<Eigen::Vector3d> direction;  ///< of any length; none: regions only
  double band = 0;                           ///< from the solid's furthest point in `direction` [m]
  std::vector<Eigen::AlignedBox3d> regions;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the frame in the mesh's coordinates, for messages
};

/// Of each cell one anchor for the outer surface that points along the direction and lies within the band,
/// and one for each flat side of what else is outer surface, polygons within 10 degrees of its first, whose
/// centroid lies in a region. Throws rubble::Error naming a region that ties nothing.
std::vector<AssetAnchor> findAnchors(const CheckedMesh& mesh, const RestrictedVoronoi& diagram,
                                     const SitePieces& pieces, const AnchorWish& wish);

}  // namespace rubble::cooking
