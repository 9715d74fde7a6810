// Loads that rest on bodies that Bullet moves, and bodies that thaw under them.
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet/body_impl.h"
#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/load_gauge.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toEigen;

// A load is left to the elements when beam theory finds this share of the strength: it knows nothing of what
// gathers stress, nor of where in Bullet's contacts the load really is.
constexpr double kLoadShare = 0.5;
// What a body has survived was the estimate's fault: it thaws again for this many times as much.
constexpr double kMoreThanSurvived = 1.5;
// What lies as it lay is looked at this often: half of the time over which the gauge smooths [s].
constexpr double kLookTime = 0.05;
// Ticks between two looks, however short they are.
constexpr double kMostTurns = 1000;
// A share below which a body that nothing touches has forgotten its loads.
constexpr double kForgotten = 1e-3;
// Elements begin unbent under a load that has been there all along, and would swing to twice the bending.
// Their deformation is damped at this rate, in frequencies of the slowest bending: a fifth of what a bending
// beam moves is deformation, so that this is over-critical for a load of up to thirty times its mass. Bending
// then takes about ten of 1 / frequency to come; it is left five times that.
constexpr double kEaseRate = 50, kEaseTimes = 50;

// Bullet's axes of the body, about its elements' centre.
Eigen::Isometry3d loadFrame(const DestructibleBody& body) {
  return toEigen(body.getWorldTransform()) * Eigen::Translation3d(implOf(body).whole.elementCentre);
}

// Bullet's solver leaves the impulses of points that it does not see as they were.
bool isSolved(const btPersistentManifold& manifold) {
  if (manifold.getNumContacts() == 0) return false;
  if (!manifold.getBody0()->hasContactResponse() || !manifold.getBody1()->hasContactResponse()) return false;
  // Elements' points get theirs from us.
  if (upcastElements(manifold.getBody0()) || upcastElements(manifold.getBody1())) return true;
  btScalar nearest = BT_LARGE_FLOAT;
  for (int p = 0; p < manifold.getNumContacts(); ++p)
    nearest = std::min(nearest, manifold.getContactPoint(p).getDistance());
  return nearest <= manifold.getContactProcessingThreshold();
}

// Visits (body, manifold, whether the body is the second of it) for whole bodies that are awake and of which
// `isWanted` says so, before a manifold's points are looked at.
template <class IsWanted, class Visit>
void visitWhole(btDispatcher& dispatcher, IsWanted&& isWanted, Visit&& visit) {
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (const bool second : {false, true}) {
      const btCollisionObject* object = second ? manifold.getBody1() : manifold.getBody0();
      if (!object->isActive()) continue;
      auto* body = const_cast<DestructibleBody*>(DestructibleBody::upcast(object));
      if (body && body->isWhole() && isWanted(*body) && isSolved(manifold)) visit(*body, manifold, second);
    }
  }
}

}  // namespace

// All that is awake by turns, for a look goes through memory that nothing else needs; in the ticks between
// them only what does not lie as it lay.
void Destruction::Impl::gatherLooked(double dt) {
  lookedWholes.clear();
  if (!(dt > 0)) return;
  const auto turn = std::uint64_t(std::clamp(std::round(kLookTime / dt), 1.0, kMostTurns));
  for (DestructibleBody* body : ticks % turn == 0 ? wholeBodies : unsettledWholes)
    if (body->getActivationState() != ISLAND_SLEEPING) lookedWholes.push_back(body);
}

void Destruction::Impl::sumPressures() {
  visitWhole(
      *world.getDispatcher(), [](const DestructibleBody& body) { return implOf(body).isLooked; },
      [](DestructibleBody& body, btPersistentManifold& manifold, bool second) {
        const btTransform& place = body.getWorldTransform();
        for (int p = 0; p < manifold.getNumContacts(); ++p) {
          const btManifoldPoint& point = manifold.getContactPoint(p);
          const btVector3& at = second ? point.getPositionWorldOnB() : point.getPositionWorldOnA();
          implOf(body).pressure.add(double(point.m_appliedImpulse), toEigen(place.invXform(at)));
        }
      });
}

void Destruction::Impl::gatherPatches(double dt) {
  visitWhole(
      *world.getDispatcher(), [](const DestructibleBody& body) { return implOf(body).isGauged; },
      [dt](DestructibleBody& body, btPersistentManifold& manifold, bool second) {
        if (auto patch = bullet::contactPatch(manifold, second, loadFrame(body), dt))
          implOf(body).patches.push_back(std::move(*patch));
      });
}

// Most that is awake lies as it lay, and is looked at no further.
void Destruction::Impl::noteLoads(double dt) {
  if (lookedWholes.empty()) return;
  BT_PROFILE("Rubble note loads");
  for (DestructibleBody* body : lookedWholes) implOf(*body).isLooked = body->isActive();
  sumPressures();
  unsettledWholes.clear();
  for (DestructibleBody* body : lookedWholes) {
    DestructibleBody::Impl& own = implOf(*body);
    if (!std::exchange(own.isLooked, false)) continue;
    bullet::limitGyroscopicTerm(*body, dt);
    bullet::Pressure pressure = std::exchange(own.pressure, {});
    if (own.held) pressure.gravity = toEigen(world.getGravity());
    own.isGauged = !own.gauge->isSettled(pressure, double(body->getAngularVelocity().length()), dt);
    if (own.isGauged) unsettledWholes.push_back(body);
  }
  if (unsettledWholes.empty()) return;
  gatherPatches(dt);
  for (DestructibleBody* body : unsettledWholes) {
    DestructibleBody::Impl& own = implOf(*body);
    own.isGauged = false;
    if (own.patches.empty() && !own.held && own.gauge->share() < kForgotten) {
      own.gauge->reset();
      continue;
    }
    const Eigen::Matrix3d into = loadFrame(*body).linear().transpose();
    bullet::RestingLoad load;
    load.contacts = own.patches;
    load.spin = into * toEigen(body->getAngularVelocity());
    load.gravity = into * toEigen(world.getGravity());
    load.held = own.held;
    own.gauge->note(load, dt);

    const double share = own.gauge->share();
    own.patches.clear();
    if (!(share > std::max(kLoadShare, kMoreThanSurvived * own.survivedLoad))) continue;
    own.struck = true;
    own.thawLoad = share;
    couple(*body);
  }
}

void Destruction::Impl::beginEasing(DestructibleBody& body) {
  const double frequency = implOf(body).gauge->slowestBending();
  implOf(body).easeTime = kEaseTimes / frequency;
  solver->setEasing(body.id(), kEaseRate * frequency);
}

void Destruction::Impl::ease(DestructibleBody& body, double dt) {
  double& left = implOf(body).easeTime;
  if (!(left > 0)) return;
  left -= dt;
  if (!(left > 0)) solver->setEasing(body.id(), 0);
}

RUBBLE_ABI_END
}  // namespace rubble
