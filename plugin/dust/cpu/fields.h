// State of the CPU back end: plain arrays, allocated once.
#pragma once

#include <vector>

#include "dust/cpu/float4.h"
#include "dust/lattice.h"

namespace rubble::dust {

struct Fields {
  explicit Fields(const Lattice& lattice)
      : velocity(lattice.cells()),
        work(lattice.cells()),
        corrected(lattice.cells()),
        density(lattice.cells()),
        air(lattice.cells(), 1.0f),
        faces(3 * lattice.facesOfAxis()),
        divergence(lattice.cells()) {}

  std::vector<Float4> velocity;  ///< (n^3) [m/s]
  std::vector<Float4> work;  ///< (n^3) curl [1/s] with its length in the fourth, then the advected velocity
  std::vector<Float4> corrected;  ///< (n^3) the corrected velocity, swapped with `velocity`
  std::vector<float> density;     ///< (n^3) [kg/m^3]
  std::vector<float> air;         ///< (n^3) 1 air, 0 solid
  std::vector<float> faces;       ///< (3 n^2 (n+1)) Lattice::face; [m/s], then Courant numbers of the dust
  std::vector<float> divergence;  ///< (n^3) [1/s]
};

}  // namespace rubble::dust
