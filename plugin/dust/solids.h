// Obstacles made ready for the grid: checked, with the cells they may cover.
#pragma once

#include <span>
#include <vector>

#include "dust/lattice.h"
#include "shared/dust.h"

namespace rubble::dust {

/// A solid and the box of cells that holds it.
struct SolidCells {
  shared::DustSolid solid;
  Eigen::Vector3i first, last;  ///< inclusive; never empty
};

/// Leaves out what is not finite, has no size or lies outside the grid; cuts velocities to kDustMaxSpeed.
/// Later obstacles win where two overlap.
void gatherSolids(const Lattice& lattice, std::span<const DustObstacle> obstacles,
                  std::vector<SolidCells>& solids);

}  // namespace rubble::dust
