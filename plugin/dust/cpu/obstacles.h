// Solids in the grid: which cells they cover, and the velocity of the body there.
#pragma once

#include <span>

#include "base/threads.h"
#include "dust/cpu/fields.h"
#include "dust/solids.h"

namespace rubble::dust {

/// Marks the cells whose centre lies in a solid and gives them its velocity, v + spin x offset.
void markSolids(const Lattice& lattice, std::span<const SolidCells> solids, Fields& fields,
                base::ThreadPool& pool);

}  // namespace rubble::dust
