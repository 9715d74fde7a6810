#include "bullet/host_settings.h"

#include <cmath>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

std::optional<btVector3> ownGravity(const btRigidBody& body, const btVector3& world) {
  const btVector3& given = body.getGravity();
  const bool isOurs =
      given.isZero() && std::signbit(given.x()) && std::signbit(given.y()) && std::signbit(given.z());
  const bool isWorlds = !(body.getFlags() & BT_DISABLE_WORLD_GRAVITY) && given == world;
  return isOurs || isWorlds ? std::nullopt : std::optional(given);
}

HostSettings settingsOf(const btRigidBody& body, const btVector3& world) {
  return {body.getLinearFactor(),
          body.getAngularFactor(),
          ownGravity(body, world).value_or(noGravity()),
          body.getFlags(),
          body.getContactProcessingThreshold(),
          body.getActivationState() == DISABLE_DEACTIVATION};
}

void restore(btRigidBody& body, const HostSettings& settings, const btVector3& world) {
  const std::optional<btVector3> own = ownGravity(body, world);
  const bool isOff = settings.flags & BT_DISABLE_WORLD_GRAVITY;
  body.setLinearFactor(settings.linearFactor);
  body.setAngularFactor(settings.angularFactor);
  body.setFlags(settings.flags);
  body.setGravity(own ? *own : isOff ? noGravity() : world);
  body.setContactProcessingThreshold(settings.threshold);
  body.forceActivationState(settings.staysAwake ? DISABLE_DEACTIVATION : ACTIVE_TAG);
  body.setDeactivationTime(0);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
