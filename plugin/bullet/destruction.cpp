#include "rubble/destruction.h"

#include <LinearMath/btIDebugDraw.h>

#include <algorithm>
#include <utility>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN

Destruction::Destruction(btDiscreteDynamicsWorld& world, const DestructionDef& def)
    : m_impl(std::make_unique<Impl>(world, def)) {
  world.addAction(this);
}

Destruction::~Destruction() {
  m_impl->world.removeAction(this);
}

DestructibleBody* Destruction::addBody(const DestructibleBodyDef& def) {
  return m_impl->addBody(def);
}

void Destruction::removeBody(DestructibleBody* body) {
  m_impl->wakeTouching(*body);
  const bullet::AnchorBody& base = implOf(*body).anchorBody;
  if (base.ridden && bullet::isThere(m_impl->world, base)) base.body->activate();
  m_impl->world.removeRigidBody(body);
  delete body;
}

void Destruction::setAnchorBody(DestructibleBody* body, btRigidBody* anchorBody) {
  if (implOf(*body).whole.shape)
    throw Error("anchorBody: of a body that Bullet may move as a whole; add it with Regime::Elements");
  edem::Twist motion;
  if (anchorBody) {
    bullet::requireAnchorBody(m_impl->world, *anchorBody, body->elementMass());
    motion = bullet::motionAt(*anchorBody, m_impl->solver->heldFrame(body->id()).origin);
  }
  m_impl->setAnchorBody(*body, anchorBody, motion);
}

void Destruction::strike(DestructibleBody* body) {
  if (!body->isWhole()) return;
  implOf(*body).struck = true;
  m_impl->couple(*body);
  body->activate(true);
}

std::span<DestructibleBody* const> Destruction::bodies() const {
  return m_impl->bodies;
}

DestructibleBody* Destruction::body(std::uint32_t id) const {
  return m_impl->bodyOf(id);
}

const Events& Destruction::takeEvents() {
  const Events& full = m_impl->events[m_impl->filling];
  m_impl->filling = 1 - m_impl->filling;
  m_impl->events[m_impl->filling].clear();
  return full;
}

const Ledger& Destruction::ledger() const {
  return m_impl->ledgerBook.ledger();
}

std::span<const DebrisPiece> Destruction::debris() const {
  return m_impl->debrisSystem ? m_impl->debrisSystem->pieces() : std::span<const DebrisPiece>{};
}

DestructionCounts Destruction::counts() const {
  DestructionCounts c;
  for (const DestructibleBody* body : m_impl->bodies) {
    const edem::BodyView view = m_impl->solver->view(body->id());
    c.elements += view.elements();
    c.crushed += view.crushed;
    c.awake += view.asleep ? 0 : view.elements() - view.crushed - view.sleepingCount;
    c.springs += view.springs();
    c.springsBroken += view.broken;
    c.fragments += view.fragments;
  }
  c.debrisAlive = m_impl->debrisSystem ? std::uint32_t(m_impl->debrisSystem->pieces().size()) : 0;
  c.debrisSpawned = m_impl->debrisSpawned;
  c.debrisRemoved = m_impl->debrisRemoved;
  c.frozen = m_impl->frozen;
  return c;
}

DestructionTimes Destruction::takeTimes() {
  return std::exchange(m_impl->times, {});
}
const std::string& Destruction::failure() const {
  return m_impl->failure;
}
double Destruction::stableSubstep() const {
  return m_impl->solver->stableStep();
}
int Destruction::lastSubsteps() const {
  return m_impl->substeps;
}
std::uint64_t Destruction::hash() const {
  m_impl->placeWholes();
  return m_impl->solver->hash();
}
std::uint64_t Destruction::debrisHash() const {
  return m_impl->debrisSystem ? m_impl->debrisSystem->hash() : 0;
}

void Destruction::updateAction(btCollisionWorld*, btScalar dt) {
  m_impl->finish(double(dt));
}

void Destruction::debugDraw(btIDebugDraw* drawer) {
  m_impl->placeWholes();
  for (const DestructibleBody* body : m_impl->bodies) {
    const edem::BodyView view = m_impl->solver->view(body->id());
    const auto radius = btScalar(m_impl->solver->radius(body->id()));
    for (std::size_t i = 0; i < view.alive.size(); ++i)
      if (view.alive[i])
        drawer->drawSphere(bullet::toBullet(m_impl->solver->position(body->id(), i)), radius,
                           btVector3(1, 0.6f, 0.2f));
  }
}

RUBBLE_ABI_END
}  // namespace rubble
