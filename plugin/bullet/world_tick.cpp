#include "bullet/world_tick.h"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btQuickprof.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "bullet/body_def.h"
#include "bullet/body_impl.h"
#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/locked_motion.h"
#include "bullet/multibody_links.h"
#include "bullet/swept_bodies.h"
#include "debris/bond.h"
#include "edem/own_weight.h"
#include "rubble/limits.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// A rigid body that Bullet holds is a rock to elements slower than this [m/s].
constexpr double kCalmSpeed = 0.1;
// Slow bending modes ring for many seconds, for the springs' dashpots damp the fast ones. Fragments that may
// sleep are helped to rest once they have been slower than this for half a second; they rise 3 mm by it
// [m/s]. The half of a wall that a ball went through rings at 0.12.
constexpr double kSettleSpeed = 0.25;
// Roundings of Bullet's numbers from one tick to the next, over their largest: its own step, ours, and the
// sum of both.
constexpr double kRoundings = 4;

// Where impulses taken as one at the tick's start give a body so many times the energy of rotation that it
// had after the substeps, it turned too far in them for that.
constexpr double kTurned = 1.05;

// Of a body of unlike inertias, turned as it is after the substeps [J].
double rotationOf(const edem::RigidProxy& proxy, const Eigen::Vector3d& spin) {
  const Eigen::Vector3d own = proxy.orientation.conjugate() * spin;
  double twice = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (proxy.inverseInertia[axis] > 0) twice += own[axis] * own[axis] / proxy.inverseInertia[axis];
  return 0.5 * twice;
}

// What has one inertia about all axes gets the same by its impulses whenever they come.
bool isUneven(const edem::RigidProxy& proxy) {
  return proxy.inverseInertia.maxCoeff() > 1.01 * proxy.inverseInertia.minCoeff();
}

float roundingOf(const edem::RigidProxy& proxy) {
  constexpr double kEpsilon = std::numeric_limits<btScalar>::epsilon();
  return float(kRoundings * kEpsilon * proxy.position.cwiseAbs().maxCoeff());
}

}  // namespace

Destruction::Impl::Impl(btDiscreteDynamicsWorld& bulletWorld, const DestructionDef& definition)
    : world(bulletWorld),
      def(definition),
      solver(edem::Solver::make(definition.precision, {.substepSafety = definition.substepSafety,
                                                       .maxSubstepsPerFrame = definition.maxSubstepsPerFrame,
                                                       .breaking = definition.breaking,
                                                       .crushing = definition.crushing,
                                                       .sleepSpeed = definition.sleep ? kQuietSpeed : 0,
                                                       .settleSpeed = definition.sleep ? kSettleSpeed : 0})),
      algorithms(*static_cast<btCollisionDispatcher*>(bulletWorld.getDispatcher())),
      proxyMaker(definition.log),
      softContacts(definition.log) {
  if (!limits::kMaxEvents.hold(def.maxEvents))
    throw Error("maxEvents: is " + std::to_string(def.maxEvents) + ", must be " + limits::kMaxEvents.text());
  if (!def.debris) return;
  debris::DebrisSystemDef system;
  system.maxDebris = def.maxDebris;
  debrisSystem = std::make_unique<debris::DebrisSystem>(system);
  surroundings = std::make_unique<bullet::DebrisSurroundings>(world, *solver, proxyMaker);
}

Destruction::Impl::~Impl() {
  while (!bodies.empty()) {
    DestructibleBody* body = bodies.back();
    world.removeRigidBody(body);
    delete body;  // forgets itself
  }
}

DestructibleBody* Destruction::Impl::addBody(const DestructibleBodyDef& bodyDef) {
  if (!bodyDef.asset) throw Error("destructible body: asset: none given");
  auto impl = std::make_unique<DestructibleBody::Impl>();
  impl->spawner = std::make_unique<debris::Spawner>(bodyDef.material, bodyDef.model, def.seed);
  edem::BodyDef elements = bullet::elementsOf(bodyDef);
  const bool carried = bodyDef.anchorBody && bodyDef.anchored && !bodyDef.asset->anchors.empty();
  edem::Twist carriedBy;
  if (carried) {
    bullet::requireAnchorBody(world, *bodyDef.anchorBody, bodyDef.material.density * bodyDef.asset->volume());
    carriedBy = bullet::motionAt(*bodyDef.anchorBody, bullet::centreOf(bodyDef));
    elements.velocity = carriedBy.linear;
    elements.spin = carriedBy.angular;
  }
  double mass = 0;
  const Material& m = bodyDef.material;
  for (const double volume : bodyDef.asset->volumes) {
    const double constant =
        debris::bondConstant(m.bondWorkIndex, m.crushEfficiency, m.sizeModulus, m.density * volume);
    impl->bondConstants.push_back(constant);
    elements.crushEnergy.push_back(debris::crushingEnergy(constant, bodyDef.asset->radius));
    mass += m.density * volume;
  }
  impl->id = solver->addBody(elements, toEigen(world.getGravity()));
  impl->name = edem::bodyName(impl->id, m, *bodyDef.asset, elements.transform, toEigen(world.getGravity()));
  impl->advice = edem::sizeAndWeightAdvice(
      {*bodyDef.asset, m, bodyDef.model, elements.transform, toEigen(world.getGravity()), bodyDef.anchored});
  logRefusedRest(impl->id, impl->name);
  if (!impl->advice.empty()) {
    if (def.log) def.log(LogLevel::Warning, impl->name + ": " + impl->advice);
  } else if (bodyDef.anchored) {
    logPrestress(impl->id, impl->name, bodyDef);  // the advice would be its reason
  }
  impl->source = impl->id;
  impl->asset = bodyDef.asset;
  impl->material = bodyDef.material;
  impl->model = bodyDef.model;
  impl->wasRoot.assign(bodyDef.asset->elementCount(), 0);
  const auto fragment = solver->view(impl->id).fragment;
  for (std::size_t i = 0; i < fragment.size(); ++i) impl->wasRoot[i] = fragment[i] == i;

  DestructibleBody* body = make(std::move(impl), mass);
  if (carried) setAnchorBody(*body, bodyDef.anchorBody, carriedBy);
  if (bodyDef.regime == Regime::RigidUntilStruck) beWhole(*body, bodyDef);
  if (!body->isWhole()) {
    bullet::beElements(*body);
    showElements(*body);
  }
  if (bodyDef.model.contactBesideSpring) energyBalance.beginAnew();  // they may press from the start
  enter(*body, bodyDef.collisionGroup, bodyDef.collisionMask);
  ledgerBook.close(solver->books(), debrisSystem ? debrisSystem->motion() : debris::Motion{});
  return body;
}

DestructibleBody* Destruction::Impl::make(std::unique_ptr<DestructibleBody::Impl> impl, double mass) {
  impl->world = this;
  impl->shape = std::make_unique<bullet::ElementShape>(*solver, impl->id);
  impl->speed = solver->maxSpeed(impl->id);
  impl->whole.mass = mass;
  btVector3 inertia;
  impl->shape->calculateLocalInertia(btScalar(mass), inertia);
  const btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, impl->shape.get(), inertia);
  auto* body = new DestructibleBody(info, std::move(impl));
  implOf(*body).coupler = std::make_unique<bullet::CouplerConstraint>(*body, *this);
  implOf(*body).shape->setObject(*body);
  return body;
}

void Destruction::Impl::enter(DestructibleBody& body, int group, int mask) {
  world.addRigidBody(&body, group, mask);
  bodies.push_back(&body);
  enlist(body);
  if (!body.isWhole()) couple(body);
}

// Says why the state that an asset keeps was of no use.
void Destruction::Impl::logRefusedRest(std::uint32_t id, const std::string& name) const {
  const std::string& refusal = solver->prestressed(id).refusal;
  if (def.log && !refusal.empty())
    def.log(LogLevel::Warning, name + ": the static state that its asset keeps was not taken: " + refusal +
                                   "; it is solved anew");
}

// Says why an anchored body does not stand still from the start.
void Destruction::Impl::logPrestress(std::uint32_t id, const std::string& name,
                                     const DestructibleBodyDef& bodyDef) const {
  if (!def.log) return;
  const edem::PrestressResult& result = solver->prestressed(id);
  if (bodyDef.asset->anchors.empty()) {
    def.log(LogLevel::Info, name + ": is to be anchored, but its asset has no anchors: it is free");
  } else if (!result.reason.empty()) {
    def.log(LogLevel::Warning,
            name + ": is anchored but was not pre-stressed: " + result.reason + "; it will settle by itself");
  }
}

void Destruction::Impl::forget(DestructibleBody& body) {
  const auto found = std::find(bodies.begin(), bodies.end(), &body);
  if (found == bodies.end()) return;
  bodies.erase(found);
  forgetJointsOf(body);
  softContacts.forget(body);
  delist(body);
  uncouple(body);
  const edem::Books before = solver->books();
  solver->removeBody(implOf(body).id);
  const edem::Books& after = solver->books();
  debris::Motion gone;
  gone.mass = after.leftMass - before.leftMass;
  gone.linear = after.leftLinear - before.leftLinear;
  gone.angular = after.leftAngular - before.leftAngular + after.centre.cross(gone.linear);
  gone.kinetic = after.leftKinetic - before.leftKinetic + after.leftElastic - before.leftElastic;
  ledgerBook.addRemoved(gone);
  ledgerStale = true;
  energyBalance.beginAnew();
  implOf(body).world = nullptr;
}

DestructibleBody* Destruction::Impl::bodyOf(std::uint32_t id) const {
  const auto found = std::ranges::lower_bound(bodies, id, {}, &DestructibleBody::id);  // in rising order
  return found != bodies.end() && (*found)->id() == id ? *found : nullptr;
}

void Destruction::Impl::wakeTouching(const DestructibleBody& body) {
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (manifold.getNumContacts() == 0) continue;
    for (const auto& [a, b] : {std::pair(manifold.getBody0(), manifold.getBody1()),
                               std::pair(manifold.getBody1(), manifold.getBody0())})
      if (a == &body) const_cast<btCollisionObject*>(b)->activate();
  }
}

void Destruction::Impl::gatherProxies(double dt) {
  BT_PROFILE("Rubble gather proxies");
  bullet::addSwept(world, bodies, dt);
  const std::vector<Eigen::AlignedBox3d> boxes = bullet::reachedBoxes(bodies, dt);
  touched.clear();
  proxies.clear();
  for (DestructibleBody* body : elementBodies) {
    bullet::AnchorBody& base = implOf(*body).anchorBody;
    std::vector<btCollisionObject*>& near = implOf(*body).near;
    const bool rides = base.body && base.ridden && body->isActive();
    if (rides && std::find(near.begin(), near.end(), base.body) == near.end()) near.push_back(base.body);
    for (btCollisionObject* object : near) {
      const auto known = [&](const bullet::TouchedBody& t) { return t.object == object; };
      if (upcastElements(object) || std::any_of(touched.begin(), touched.end(), known)) continue;
      edem::RigidProxy proxy = proxyMaker.make(*object, boxes);
      auto* link = btMultiBodyLinkCollider::upcast(object);
      if (link) bullet::take(*link, dt, proxy);
      if (proxy.parts.empty() && !(rides && base.is(*object))) continue;
      bullet::TouchedBody t;
      t.object = object;
      if (proxy.isDynamic()) {
        t.rigid = btRigidBody::upcast(object);
        proxy.placed = t.rigid && wasPlaced(*object);
        if (t.rigid) proxy.rounding = roundingOf(proxy);
        t.link = link;
        t.velocity = toBullet(proxy.velocity);
        t.spin = toBullet(proxy.spin);
        t.acceleration = toBullet(proxy.acceleration);
        t.angularAcceleration = toBullet(proxy.angularAcceleration);
        // Without it a crate that stands on the ground would fall through every tick's substeps and be put
        // back. Under what lies on it calmly it stands like a rock, for Bullet holds it again after the tick.
        for (const bullet::Reaction& held : reactions) {
          if (held.body != object) continue;
          proxy.acceleration += toEigen(held.linear);
          proxy.angularAcceleration += toEigen(held.angular);
        }
        if (isHeld(*object) && speedOn(*object, *body) < kCalmSpeed) {
          t.held = true;
          proxy.inverseMass = 0;
          proxy.mobility.reset();
          proxy.kinematic = true;
          proxy.velocity.setZero();
          proxy.spin.setZero();
        }
      }
      touched.push_back(t);
      proxies.push_back(std::move(proxy));
    }
    near.clear();
  }
  coupleLinks();
  spareFiltered();
  bearAnchored();
}

// The copies of all bodies' neighbours are one list: what one body touches another may have to let through.
void Destruction::Impl::spareFiltered() {
  if (bodies.size() < 2) return;
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    btCollisionObject& object = *touched[p].object;
    if (!object.getBroadphaseHandle()) continue;  // gone from the world since the narrowphase
    for (DestructibleBody* body : elementBodies)
      if (body->isActive() && !bullet::mayTouch(world, *body, object))
        proxies[p].spared.push_back(body->id());
  }
}

void Destruction::Impl::advance(double dt) {
  // Each body's coupler comes, and when nothing is awake all would look at all bodies.
  if (std::exchange(begun, true) || !failure.empty()) return;
  softContacts.deliver(*solver, dt);
  substeps = 0;
  if (elementBodies.empty() && coupledWholes == 0) return;
  BT_PROFILE("Rubble advance");
  takeHostMoves(dt);
  carryAnchored(dt);
  followSleep();
  failSpoiled(wholeBodies);
  if (!failure.empty()) return;
  thawStruck(dt);
  if (elementBodies.empty() || !solver->anyAwake()) return;
  advanced = true;
  const base::ScopeTimer timer(times.edem);
  gatherJoints();
  loadJoints(dt);
  gatherProxies(dt);
  energyAlarm.begin(proxies);
  std::vector<edem::RigidProxy> start = proxies;
  {
    BT_PROFILE("Rubble substeps");
    solver->tick(dt, toEigen(world.getGravity()), proxies);
  }
  times.neighbours += solver->report().listing;
  times.edem -= solver->report().listing;
  substeps = solver->report().substeps;
  if (!solver->failure().empty()) {
    failSolver();
    touched.clear();  // gets none of it
    proxies.clear();
    return;
  }
  followElements();
  poseJoints(dt);
  frozen += solver->report().frozen;
  const bool warns = def.log && !solver->report().warning.empty(),
             isFirstFrozen = frozen > 0 && frozen == solver->report().frozen;
  if (warns && (!std::exchange(warned, true) || isFirstFrozen))
    def.log(LogLevel::Warning, solver->report().warning);
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    bullet::TouchedBody& t = touched[p];
    if (!t.rigid) continue;
    const edem::RigidProxy& s = start[p];
    Eigen::Vector3d change = double(t.rigid->getInvMass()) * proxies[p].impulse;
    t.deltaSpin = t.rigid->getInvInertiaTensorWorld() * toBullet(proxies[p].angularImpulse);
    if (const auto locked = bullet::lockedMobility(*t.rigid)) {
      change = locked->topLeftCorner<3, 3>() * proxies[p].impulse;
      t.deltaSpin = toBullet(Eigen::Vector3d(locked->bottomRightCorner<3, 3>() * proxies[p].angularImpulse));
    }
    t.deltaVelocity = toBullet(change);
    const Eigen::Vector3d turning = s.spin + dt * s.angularAcceleration, own = proxies[p].spin;
    if (!s.mobility && proxies[p].isPressed() && isUneven(s) &&
        rotationOf(proxies[p], turning + toEigen(t.deltaSpin)) > kTurned * rotationOf(proxies[p], own))
      t.deltaSpin = toBullet(Eigen::Vector3d(own - turning));
    // Where Bullet brings it under the same impulses, taken as one at the tick's start.
    const btTransform begin(toBullet(s.orientation), toBullet(s.position));
    btTransformUtil::integrateTransform(
        begin, toBullet(Eigen::Vector3d(s.velocity + dt * s.acceleration + change)),
        toBullet(Eigen::Vector3d(s.spin + dt * s.angularAcceleration)) + t.deltaSpin, btScalar(dt),
        t.freeEnd);
    if (proxies[p].isPressed() && !t.rigid->isActive()) t.rigid->activate();
  }
  giveLinks(dt, start);
  for (DestructibleBody* body : elementBodies) implOf(*body).shape->setHidden(true);
}

// What asks from now on, even before the tick is over, finds the elements where the substeps left them.
void Destruction::Impl::followElements() {
  if (!failure.empty()) return;  // places may not be numbers
  for (DestructibleBody* body : elementBodies)
    if (!solver->view(body->id()).lies() || !implOf(*body).lay) implOf(*body).shape->follow();
}

void Destruction::Impl::finish(double dt) {
  BT_PROFILE("Rubble finish");
  advance(dt);
  pushOut.restore(*world.getDispatcher());
  for (DestructibleBody* body : elementBodies) {
    implOf(*body).shape->setHidden(false);
    implOf(*body).near.clear();
  }
  if (advanced) {
    forgetTaken();
    lateImpulses();
    noteReactions(dt);
    fixPositions();
    noteLeftPlaces();
    takeJoints(dt);
    writeAppliedImpulses();
    const base::ScopeTimer timer(times.fracture);
    bookEvents();
    breakElements();
    splitBodies();
  }
  const bool hadDebris = std::exchange(hasDebris, debrisSystem && !debrisSystem->pieces().empty());
  if ((hadDebris || hasDebris) && failure.empty()) {
    const base::ScopeTimer timer(times.debris);
    stepDebris(dt);
    ledgerStale = true;
  }
  gatherAwakeWholes(dt);
  noteLoads(dt);
  freezeCalm(dt);
  closeLedger(dt);
  finishThaws();
  showElements();
  failSpoiled(awakeWholes);
  updateSleep(dt);
  for (DestructibleBody* body : elementBodies) implOf(*body).inSolver = false;
  uncoupleIdle();
  pushOut.note(world.getSolverInfo(), dt);
  softContacts.close();
  begun = advanced = lookedForBlows = false;
  ++ticks;
  seconds += dt;
}

void Destruction::Impl::closeLedger(double dt) {
  if (!advanced && !std::exchange(ledgerStale, false)) return;
  ledgerBook.close(solver->books(), debrisSystem ? debrisSystem->motion() : debris::Motion{});
  double next = 0;
  for (const edem::RigidProxy& proxy : proxies)
    if (advanced && proxy.isDynamic()) next += proxy.givenNext;
  ledgerBook.setExchangedNext(next);
  if (!advanced || !failure.empty()) return;
  const auto lines = energyAlarm.end(touched, proxies, dt, ledgerBook.ledger().energyScale);
  ledgerBook.addMade(energyAlarm.made(), energyAlarm.told());
  if (def.log)
    for (const std::string& line : lines) def.log(LogLevel::Warning, line);
  judgeDamping();
  judgeBalance();
}

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
