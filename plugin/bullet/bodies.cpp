// The bodies of a world: how they come, in which lists they stand, how they go.
#include <algorithm>
#include <utility>

#include "bullet/body_def.h"
#include "bullet/body_impl.h"
#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "debris/bond.h"
#include "edem/own_weight.h"

namespace rubble {
RUBBLE_ABI_BEGIN

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
  impl->id = solver->addBody(elements, bullet::toEigen(world.getGravity()));
  impl->name =
      edem::bodyName(impl->id, m, *bodyDef.asset, elements.transform, bullet::toEigen(world.getGravity()));
  impl->advice = edem::sizeAndWeightAdvice({*bodyDef.asset, m, bodyDef.model, elements.transform,
                                            bullet::toEigen(world.getGravity()), bodyDef.anchored});
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

// Lists of bodies by who moves them, in rising order of ids as `bodies`.
void Destruction::Impl::enlist(DestructibleBody& body) {
  std::vector<DestructibleBody*>& list = body.isWhole() ? wholeBodies : elementBodies;
  list.insert(std::ranges::upper_bound(list, body.id(), {}, &DestructibleBody::id), &body);
  if (body.isWhole()) unsettledWholes.push_back(&body);
}

void Destruction::Impl::delist(DestructibleBody& body) {
  std::vector<DestructibleBody*>& list = body.isWhole() ? wholeBodies : elementBodies;
  const auto found = std::ranges::lower_bound(list, body.id(), {}, &DestructibleBody::id);
  if (found != list.end() && *found == &body) list.erase(found);
  std::erase(unsettledWholes, &body);
}

void Destruction::Impl::setState(DestructibleBody& body, DestructibleBody::Impl::State state) {
  DestructibleBody::Impl& own = implOf(body);
  delist(body);
  if (body.isWhole()) coupledWholes -= own.coupled;
  own.state = state;
  if (body.isWhole()) coupledWholes += own.coupled;
  enlist(body);
}

RUBBLE_ABI_END
}  // namespace rubble
