// The frame's dust sources, summed per cell on the CPU: no two entries share a cell, so scattering them needs
// no atomics and gives the same bits on every run and back end.
#pragma once

#include <span>
#include <vector>

#include "dust/lattice.h"
#include "shared/dust.h"

namespace rubble::dust {

class SourceCells {
 public:
  /// Sums `sources` (law 10: P m kilograms into the nearest cell, whose velocity becomes the mass-weighted
  /// mean of the elements broken there). Skips a source that is not finite, whose mass is not in (0,
  /// kDustMaxSourceMass].
  void gather(const Lattice& lattice, std::span<const DustSource> sources);

  std::span<const shared::DustSourceCell> cells() const { return m_cells; }
  double emitted() const { return m_emitted; }  // [kg], accepted sources inside and outside
  double outside() const { return m_outside; }  // [kg], of which outside the grid

 private:
  std::vector<std::pair<int, int>> m_order;  // (cell, source)
  std::vector<shared::DustSourceCell> m_cells;
  double m_emitted = 0, m_outside = 0;
};

}  // namespace rubble::dust
