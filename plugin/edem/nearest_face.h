// Where a ball of a rigid body meets the exposed faces of an element.
#pragma once

#include <limits>

#include "edem/cell_faces.h"

namespace rubble::edem {

/// Nearest point of the exposed faces that a ball at `centre` sees: from outside those whose front it is at;
/// from inside the cell all of them, by their planes, for the surface goes on in the next cell. Axes of the
/// element at rest, about its centre. What is beyond a face that is not exposed is inside, too.
///
/// An edge or a corner of what ends flush with a cell is on a side of it, which looks as a side of the body
/// does: it presses no face like that, and is inside the cell that is behind it by less than `flush`. Else a
/// box on a block as wide as itself had nothing to stand on.
struct NearestFace {
  /// `sides`: outward normals of the body's, which meet at `centre`.
  NearestFace(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
              const Eigen::Vector3d& centre, double radius, std::span<const Eigen::Vector3d> sides = {},
              double flush = 0);

  double distance = std::numeric_limits<double>::infinity();  ///< infinite: it sees none [m]
  bool inside = true;                                         ///< behind all exposed faces
  double beyond = 0;                                          ///< a face that is not [m]
  Eigen::Vector3d at;                                         ///< [m]
  Eigen::Vector3d normal;                                     ///< of the face
};

}  // namespace rubble::edem
