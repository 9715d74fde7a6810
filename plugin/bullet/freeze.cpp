// Bodies of elements that have come to rest in one piece, and are Bullet's again.
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <utility>

#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/thaw.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// What a body has to be for as long as kRestTime [s] before it is whole again.
// Its motion as a whole is slower than this share of the speed from which it would be struck by what it
// meets: it does not fly into the next blow.
constexpr double kMotionShare = 0.5;
// What trembles beside that is slower than this share of that speed: the stress of the waves that are still
// in it is a tenth of the tensile strength, a fifth of what a blow needs.
constexpr double kTrembleShare = 0.2;
// No spring holds more than this share of its tensile strength: what a load nearly breaks stays elements.
constexpr double kStressShare = 0.5;
// No element jumps further when the body takes its rest shape [radii].
constexpr double kJumpRadii = 0.1;
// Nothing is further in it: Bullet would push it out, a fifth of the way in its next tick [radii].
constexpr double kOverlapRadii = 0.2;
constexpr double kRestTime = 0.25;

bool isCalm(const edem::Unrest& unrest, double strikingSpeed, double radius) {
  return unrest.speed < kMotionShare * strikingSpeed && unrest.trembling < kTrembleShare * strikingSpeed &&
         unrest.stress < kStressShare && unrest.deformation < kJumpRadii * radius &&
         unrest.overlap < kOverlapRadii * radius;
}

}  // namespace

void Destruction::Impl::freezeCalm(double dt) {
  if (!advanced || !failure.empty()) return;
  BT_PROFILE("Rubble freeze calm");
  for (std::size_t b = 0; b < elementBodies.size();) {
    DestructibleBody* body = elementBodies[b++];
    DestructibleBody::Impl& own = implOf(*body);
    if (own.state != DestructibleBody::Impl::State::Elements || !own.whole.shape) continue;
    const std::optional<edem::Unrest> unrest = solver->unrest(own.id);
    const bool calm = unrest && isCalm(*unrest, bullet::strikingSpeed(own.material), solver->radius(own.id));
    const bool eased = own.easeTime > 0;  // and would bend further
    own.restTime = calm && !eased ? own.restTime + dt : 0;
    if (!(own.restTime > kRestTime)) continue;
    freeze(*body);
    --b;  // it has left the list
  }
}

// Bullet has moved what was in its solver; it takes the body from its next tick on.
void Destruction::Impl::freeze(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  const edem::ParkedMotion motion = *solver->park(own.id);
  setState(body, DestructibleBody::Impl::State::Whole);
  own.survivedLoad = std::max(own.survivedLoad, std::exchange(own.thawLoad, 0));
  own.gauge->reset();
  const Eigen::Isometry3d at = motion.place * own.whole.frame;
  bullet::beRigid(body, toBullet(at));
  bullet::restore(body, own.settings, world.getGravity());
  // Bullet's centre may be beside that of the elements.
  const Eigen::Vector3d arm = at.linear() * own.whole.elementCentre;
  const Eigen::Vector3d angular = motion.angularMomentum + arm.cross(own.whole.mass * motion.velocity);
  const Eigen::Vector3d spin =
      at.linear() * (at.linear().transpose() * angular).cwiseQuotient(toEigen(own.whole.inertia));
  body.setLinearVelocity(toBullet(motion.velocity));
  body.setAngularVelocity(toBullet(spin));
  body.setInterpolationLinearVelocity(body.getLinearVelocity());
  body.setInterpolationAngularVelocity(body.getAngularVelocity());
  body.applyGravity();  // for the ticks that are left of this call: Bullet did it at the call's start
  cleanPairs(body);
  world.updateSingleAabb(&body);
}

RUBBLE_ABI_END
}  // namespace rubble
