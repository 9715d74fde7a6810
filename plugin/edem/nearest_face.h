// Where a ball of a rigid body meets the exposed faces of an element.
#pragma once

#include <limits>

#include "edem/cell_faces.h"

namespace rubble::edem {

/// Nearest point of the exposed faces that a ball at `centre` sees: from outside those whose front it is at;
/// from inside the cell all of them, by their planes, for the surface goes on in the next cell. Axes of the
/// element at rest, about its centre. What is beyond a face that is not exposed is inside, too.
struct NearestFace {
  NearestFace(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
              const Eigen::Vector3d& centre, double radius);

  double distance = std::numeric_limits<double>::infinity();  ///< infinite: it sees none [m]
  bool inside = true;                                         ///< behind all exposed faces
  double beyond = 0;                                          ///< a face that is not [m]
  Eigen::Vector3d at;                                         ///< [m]
  Eigen::Vector3d normal;                                     ///< of the face
};

}  // namespace rubble::edem
