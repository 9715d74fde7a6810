// A column: a round shaft between a square base and a square capital.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "rubble/cook.h"

namespace rubble::demo {

struct ColumnForm {
  Eigen::Vector3d size;    ///< full edge lengths of the box around it [m]
  double shaft;            ///< diameter of the shaft [m], below x and z of the size
  double plinth;           ///< height of the base, and of the capital [m], below half of the size's y
  std::uint32_t segments;  ///< flat strips of the shaft, a multiple of 4
};

/// About the origin, upright along y: one closed surface.
SurfaceMesh columnMesh(const ColumnForm& form);

}  // namespace rubble::demo
