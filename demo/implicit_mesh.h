// The surface where a function of place is 0, as triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>

#include "rubble/cook.h"

namespace rubble::demo {

/// Below 0 inside of the solid, above 0 outside; best a distance [m].
using Field = std::function<double(const Eigen::Vector3d&)>;

/// Places where the field is looked at: counts x spacing along each axis, from the origin on. The whole
/// border of this grid lies outside of the solid.
struct SampleGrid {
  Eigen::Vector3d origin;     ///< [m]
  double spacing;             ///< [m]
  std::array<int, 3> counts;  ///< 2 or more
};

/// Always closed, outward and with two triangles an edge, whatever the field is. Parts thinner than the
/// spacing may be missed. A plane half way between two layers of the grid comes out flat.
SurfaceMesh implicitMesh(const Field& field, const SampleGrid& grid);

}  // namespace rubble::demo
