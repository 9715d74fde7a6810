// One row of bricks, with nothing in the joints between them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "rubble/cook.h"

namespace rubble::demo {

struct BrickCourse {
  Eigen::Vector3d brick;  ///< full edge lengths of one [m]
  std::uint32_t bricks;   ///< what the course has the length of, along x
  double joint;           ///< between two bricks [m]
  double offset;          ///< of the joints along x [a brick and a joint]; the first and last brick are cut
};

/// What is wrong with the offset, as "must ...", or "": what it cuts off must be a tenth of a brick or more.
std::string wrongOffset(const BrickCourse& course);

/// About the origin; each brick a closed box of its own. `course` that `wrongOffset` has nothing against.
SurfaceMesh brickCourseMesh(const BrickCourse& course);

}  // namespace rubble::demo
