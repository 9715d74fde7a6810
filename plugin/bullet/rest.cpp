// What sleeps: Bullet's own rules, told what the elements do.
#include <LinearMath/btQuickprof.h>

#include <algorithm>

#include "bullet/body_impl.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN

// Bullet has put islands to sleep, or woken them.
void Destruction::Impl::followSleep() {
  BT_PROFILE("Rubble follow sleep");
  for (DestructibleBody* body : elementBodies)
    if (implOf(*body).state == DestructibleBody::Impl::State::Elements)
      solver->setAsleep(body->id(), !body->isActive());
}

// Bullet's own rules decide who sleeps; we tell it whether anything moves.
void Destruction::Impl::updateSleep(double dt) {
  if (elementBodies.empty()) return;
  BT_PROFILE("Rubble update sleep");
  for (DestructibleBody* body : elementBodies) {
    ease(*body, dt);
    const std::uint32_t id = body->id();
    const double speed = implOf(*body).speed = solver->maxSpeed(id);
    const bool quiet = def.sleep && speed < kQuietSpeed && !(implOf(*body).easeTime > 0);
    if (!quiet) {
      body->forceActivationState(DISABLE_DEACTIVATION);
      body->setDeactivationTime(0);
    } else if (body->getActivationState() == DISABLE_DEACTIVATION) {
      body->forceActivationState(ACTIVE_TAG);
    }
    const bool lies = solver->view(id).lies();
    // It has waited for each of its fragments: Bullet need not wait once more.
    if (quiet && lies) body->setDeactivationTime(std::max(body->getDeactivationTime(), gDeactivationTime));
    if (!lies || !implOf(*body).lay) implOf(*body).shape->refit(speed * dt);
    implOf(*body).lay = lies;
  }
  waitForAnchored();
}

RUBBLE_ABI_END
}  // namespace rubble
