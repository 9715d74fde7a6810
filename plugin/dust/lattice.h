// The cells of the grid: n^3 of them, x fastest, values at their centres, normal velocities on their faces.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "rubble/dust.h"

namespace rubble::dust {

struct Lattice {
  int n = 0;               ///< cells along each axis
  Eigen::Vector3f origin;  ///< low corner [m]
  Eigen::Vector3f cell;    ///< size of a cell [m]

  explicit Lattice(const DustGridDef& def)
      : n(def.resolution), origin(def.min), cell((def.max - def.min) / float(def.resolution)) {}

  std::size_t cells() const { return std::size_t(n) * n * n; }
  std::size_t facesOfAxis() const { return std::size_t(n) * n * (n + 1); }
  int index(int x, int y, int z) const { return (z * n + y) * n + x; }
  double volume() const { return double{cell.x()} * double{cell.y()} * double{cell.z()}; }

  /// Low face of cell (x, y, z) along `axis`; the coordinate on that axis runs to n inclusive.
  std::size_t face(int axis, int x, int y, int z) const {
    const int nx = axis == 0 ? n + 1 : n, ny = axis == 1 ? n + 1 : n;
    return facesOfAxis() * axis + (std::size_t(z) * ny + y) * nx + x;
  }

  /// The cell that holds a point, -1 outside. Nothing finite or not overflows: compared before it is
  /// converted.
  int cellAt(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f p = (point - origin).cwiseQuotient(cell);
    const float end = float(n);
    for (int a = 0; a < 3; ++a) {
      if (!(p[a] >= 0 && p[a] < end)) return -1;
    }
    return index(int(p.x()), int(p.y()), int(p.z()));
  }
};

}  // namespace rubble::dust
