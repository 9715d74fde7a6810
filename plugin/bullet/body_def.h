// The definition of a body as the elements' solver takes it.
#pragma once

#include "bullet/convert.h"
#include "edem/body.h"
#include "rubble/destruction.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Centre of mass, in the world [m].
inline Eigen::Vector3d centreOf(const DestructibleBodyDef& def) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < def.asset->elementCount(); ++i)
    sum += def.asset->volumes[i] / def.asset->volume() * def.asset->positions[i];
  return toEigen(def.transform) * sum;
}

/// All but the crushing energies, which the debris' constants give.
inline edem::BodyDef elementsOf(const DestructibleBodyDef& def) {
  edem::BodyDef elements;
  elements.asset = def.asset;
  elements.material = def.material;
  elements.model = def.model;
  elements.transform = toEigen(def.transform);
  elements.velocity = toEigen(def.velocity);
  elements.spin = toEigen(def.spin);
  elements.massDamping = def.massDamping;
  elements.anchored = def.anchored;
  return elements;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
