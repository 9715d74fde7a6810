// The air carries its own velocity: MacCormack with limiter [Selle08].
#pragma once

#include "base/threads.h"
#include "dust/cpu/fields.h"

namespace rubble::dust {

/// Semi-Lagrangian step of `velocity` into `work`.
void advect(const Lattice& lattice, float dt, Fields& fields, base::ThreadPool& pool);
/// Adds half of what a step back fails to restore, kept within the eight cells of the departure point of the
/// old field; exchanges the result with `velocity`.
void correctAdvection(const Lattice& lattice, float dt, Fields& fields, base::ThreadPool& pool);

}  // namespace rubble::dust
