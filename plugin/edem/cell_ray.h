// A straight line against the faces of a cell.
#pragma once

#include <cstdint>
#include <optional>

#include "edem/cell_faces.h"

namespace rubble::edem {

/// Where a ray enters a cell.
struct CellEntry {
  double t;                ///< at from + t along
  Eigen::Vector3d normal;  ///< of the triangle that it passes, unit, out of the cell
};

/// First place with 0 <= t <= `limit` where the ray comes into the cell of `element` from outside, through
/// any of its faces; places are about the element's centre, asset axes. `along` is not 0.
std::optional<CellEntry> firstEntry(const CellFaces& cells, std::uint32_t element,
                                    const Eigen::Vector3d& from, const Eigen::Vector3d& along, double limit);

}  // namespace rubble::edem
