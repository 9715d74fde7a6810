// A uniform grid over points, hashed so that it has no bounds. Rebuilt whole by counting sort; no allocation
// once its vectors have grown to the number of points.
#pragma once

#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "edem/types.h"

namespace rubble::edem {

template <class Real>
class Grid {
 public:
  using Cell = Eigen::Vector3i;

  /// Points with `use` 0 are left out. `cellSize` > 0 [m].
  void build(std::span<const Vec3<Real>> points, std::span<const std::uint8_t> use, Real cellSize) {
    m_inverse = Real(1) / cellSize;
    const std::size_t buckets = std::bit_ceil(points.size() * 2 + 1);
    m_mask = std::uint32_t(buckets - 1);
    m_start.assign(buckets + 1, 0);
    m_cells.resize(points.size());
    m_sorted.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!use[i]) continue;
      m_cells[i] = cellOf(points[i]);
      ++m_start[bucket(m_cells[i]) + 1];
    }
    for (std::size_t b = 0; b < buckets; ++b) m_start[b + 1] += m_start[b];
    m_fill.assign(m_start.begin(), m_start.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (use[i]) m_sorted[m_fill[bucket(m_cells[i])]++] = std::uint32_t(i);
    }
  }

  Cell cellOf(const Vec3<Real>& p) const {
    return Cell(clampedFloor(p.x() * m_inverse), clampedFloor(p.y() * m_inverse),
                clampedFloor(p.z() * m_inverse));
  }

  /// Calls visit(index) for every point in `cell`, in rising order of index.
  template <class Visit>
  void visitCell(const Cell& cell, Visit&& visit) const {
    const std::uint32_t b = bucket(cell);
    for (std::uint32_t s = m_start[b]; s < m_start[b + 1]; ++s) {
      const std::uint32_t i = m_sorted[s];
      if (m_cells[i] == cell) visit(i);
    }
  }

  /// Calls visit(index) for every point in the cells that the box [low, high] touches.
  template <class Visit>
  void visitBox(const Vec3<Real>& low, const Vec3<Real>& high, Visit&& visit) const {
    const Cell a = cellOf(low), b = cellOf(high);
    for (int z = a.z(); z <= b.z(); ++z)
      for (int y = a.y(); y <= b.y(); ++y)
        for (int x = a.x(); x <= b.x(); ++x) visitCell(Cell(x, y, z), visit);
  }

  /// How many cells the box touches (as a double: boxes can be huge).
  double cellsIn(const Vec3<Real>& low, const Vec3<Real>& high) const {
    const Cell a = cellOf(low), b = cellOf(high);
    return (double(b.x()) - a.x() + 1) * (double(b.y()) - a.y() + 1) * (double(b.z()) - a.z() + 1);
  }

 private:
  // Far fragments share the outermost cells: their int must not overflow.
  static int clampedFloor(Real x) {
    constexpr Real kLimit = Real(1 << 29);
    return int(std::floor(std::fmin(std::fmax(x, -kLimit), kLimit)));
  }
  std::uint32_t bucket(const Cell& c) const {
    // Three large primes, Teschner et al. 2003.
    return (std::uint32_t(c.x()) * 73856093u ^ std::uint32_t(c.y()) * 19349663u ^
            std::uint32_t(c.z()) * 83492791u) &
           m_mask;
  }

  Real m_inverse = 1;
  std::uint32_t m_mask = 0;
  std::vector<std::uint32_t> m_start, m_fill, m_sorted;
  std::vector<Cell> m_cells;
};

}  // namespace rubble::edem
