#include "bullet/host_settings.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

HostSettings settingsOf(const btRigidBody& body) {
  return {body.getLinearFactor(),
          body.getAngularFactor(),
          body.getGravity(),
          body.getFlags(),
          body.getContactProcessingThreshold(),
          body.getActivationState() == DISABLE_DEACTIVATION};
}

void restore(btRigidBody& body, const HostSettings& settings, const btVector3& gravity) {
  body.setLinearFactor(settings.linearFactor);
  body.setAngularFactor(settings.angularFactor);
  body.setFlags(settings.flags);
  body.setGravity(settings.flags & BT_DISABLE_WORLD_GRAVITY ? settings.gravity : gravity);
  body.setContactProcessingThreshold(settings.threshold);
  body.forceActivationState(settings.staysAwake ? DISABLE_DEACTIVATION : ACTIVE_TAG);
  body.setDeactivationTime(0);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
