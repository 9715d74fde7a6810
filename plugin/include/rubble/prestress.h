// The static state of anchored bodies, made ahead: solved once, saved with the asset, found again by every
// body that is made of it.
#pragma once

#include "rubble/destruction.h"

namespace rubble {
RUBBLE_ABI_BEGIN

/// A copy of `def.asset` that keeps the static state of an anchored body made by `def` under `gravity`, ready
/// to be saved. Give the definition that addBody will get (asset, material, model and the transform's
/// rotation matter; velocities do not), the world's gravity and DestructionDef::precision: for other ones
/// addBody solves anew, and logs a warning. Takes as long as addBody does without it. Throws rubble::Error
/// for a bad definition, a body without anchors, no gravity, or when no static state is found.
Asset prestress(const DestructibleBodyDef& def, const btVector3& gravity,
                Precision precision = Precision::Float);

RUBBLE_ABI_END
}  // namespace rubble
