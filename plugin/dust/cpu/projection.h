// The two halves of the projection around the pressure solve. Velocities live at cell centres; the divergence
// is that of the face velocities (means of the two cells), which the projection makes divergence-free exactly
// up to the solver's residual, while the cells follow approximately [Almgren96]. Dust is carried by the
// faces.
#pragma once

#include "base/threads.h"
#include "dust/cpu/fields.h"

namespace rubble::dust {

/// Face velocities and their divergence. A face of a solid moves with it; the floor is closed; an open side
/// lets the velocity of its cell through.
void computeFaces(const Lattice& lattice, Fields& fields, base::ThreadPool& pool);
void computeDivergence(const Lattice& lattice, Fields& fields, base::ThreadPool& pool);

/// Pressure of one cell row with a zero cell on either side of the grid: pressure[index(x, y, z)] for -1 <=
/// x, y, z <= n.
struct PaddedPressure {
  const float* values;
  int stride;  ///< n + 2
  const float* row(int y, int z) const { return values + (long(z + 1) * stride + y + 1) * stride + 1; }
};

/// Subtracts the gradient of the pressure from faces and cells.
void subtractGradient(const Lattice& lattice, PaddedPressure pressure, Fields& fields,
                      base::ThreadPool& pool);

}  // namespace rubble::dust
