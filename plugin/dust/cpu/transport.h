// The air carries the dust, which settles through it.
//
// DEVIATION from MacCormack for the density: it loses and makes mass, and a correction by a factor hides
// where. Here dust moves through faces by a limited second-order flux [vanLeer77], one axis at a time, in
// substeps of at most one cell: what leaves a cell enters its neighbour, to the last bit but rounding; no
// density falls below zero; and the dust that goes through the sides and the floor is the flux itself,
// counted where it happens.
#pragma once

#include "base/threads.h"
#include "dust/cpu/fields.h"

namespace rubble::dust {

/// Dust that went through the sides, as the sum of density x cells [kg/m^3]; times the volume of a cell it is
/// kilograms.
struct Outflow {
  double settled = 0;
  double left = 0;
};

/// Turns the face velocities into Courant numbers of the dust for the whole step: air velocity, less the
/// settling speed [m/s] on y faces; solids let dust out but not in. Returns the number of substeps.
int toCourantNumbers(const Lattice& lattice, float dt, float settling, Fields& fields,
                     base::ThreadPool& pool);

/// `partial` (n) holds sums per slab, so that the total does not depend on threads.
Outflow carryDust(const Lattice& lattice, int substeps, Fields& fields, std::vector<Outflow>& partial,
                  base::ThreadPool& pool);

}  // namespace rubble::dust
