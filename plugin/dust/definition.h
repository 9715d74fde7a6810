// Checks of a grid's definition, and what follows from it.
#pragma once

#include "rubble/dust.h"

namespace rubble::dust {

/// Throws rubble::Error naming the key, its value and what is allowed.
void checkDefinition(const DustGridDef& def);

/// Stokes: 2/9 (rho_p - rho_a) g R^2 / mu [m/s], downwards. Right for a Reynolds number below 1 (R up to 40
/// micrometres in air); cut at the largest speed of the grid.
float settlingSpeed(const DustGridDef& def);

}  // namespace rubble::dust
