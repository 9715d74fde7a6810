// Body forces: weight of the dust, vorticity confinement [Fedkiw01], drag, and the sponge at the open sides.
#pragma once

#include "base/threads.h"
#include "dust/cpu/fields.h"

namespace rubble::dust {

struct ForceConstants {
  float dt;         ///< [s]
  float load;       ///< g / density of air [m^4/(kg s^2)]
  float gravity;    ///< [m/s^2]
  float vorticity;  ///< dimensionless
  float decay;      ///< exp(-drag dt)
};

/// Curl of the velocity and its length, into `work`.
void computeCurl(const Lattice& lattice, Fields& fields, base::ThreadPool& pool);
/// Adds the forces to the velocity; needs the curl unless constants.vorticity is 0.
void applyForces(const Lattice& lattice, const ForceConstants& constants, Fields& fields,
                 base::ThreadPool& pool);

}  // namespace rubble::dust
