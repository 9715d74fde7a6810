#include "rubble/destructible_body.h"

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN

DestructibleBody::DestructibleBody(const btRigidBodyConstructionInfo& info, std::unique_ptr<Impl> impl)
    : btRigidBody(info), m_impl(std::move(impl)) {
  setUserIndex3(kDestructibleMark);
  setIgnoreCollisionCheck(this, true);  // while there is one that it ignores, Bullet asks it
}

bool DestructibleBody::checkCollideWithOverride(const btCollisionObject* other) const {
  // In its list of whom it ignores it stands itself, and the list in memory that nothing else needs.
  const bool may = m_objectsWithoutCollisionCheck.size() == 1 || btRigidBody::checkCollideWithOverride(other);
  if (may && m_impl->world) m_impl->world->meet(const_cast<DestructibleBody&>(*this), *other);
  return may;
}

DestructibleBody::~DestructibleBody() {
  if (m_impl->world) m_impl->world->forget(*this);
}

const DestructibleBody* DestructibleBody::upcast(const btCollisionObject* object) {
  const bool ours = btRigidBody::upcast(object) && object->getUserIndex3() == kDestructibleMark;
  return ours ? static_cast<const DestructibleBody*>(object) : nullptr;
}
DestructibleBody* DestructibleBody::upcast(btCollisionObject* object) {
  return const_cast<DestructibleBody*>(upcast(static_cast<const btCollisionObject*>(object)));
}

std::uint32_t DestructibleBody::id() const {
  return m_impl->id;
}
std::uint32_t DestructibleBody::source() const {
  return m_impl->source;
}
const std::shared_ptr<const Asset>& DestructibleBody::asset() const {
  return m_impl->asset;
}
const Material& DestructibleBody::material() const {
  return m_impl->material;
}
const Model& DestructibleBody::model() const {
  return m_impl->model;
}

void DestructibleBody::poses(std::span<ElementPose> out) const {
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  // The solver's are placed when it needs them; nothing is written here, so that threads may ask at once.
  const Eigen::Isometry3d place = bullet::toEigen(getWorldTransform()) * m_impl->whole.frame.inverse();
  if (isWhole() && !m_impl->held && place.matrix().allFinite()) {
    const Eigen::Vector4f turn = Eigen::Quaterniond(place.linear()).normalized().coeffs().cast<float>();
    const std::vector<Eigen::Vector3d>& positions = m_impl->asset->positions;
    for (std::size_t i = 0; i < out.size() && i < positions.size(); ++i)
      out[i] = {(place * positions[i]).cast<float>(), 1.0f, turn};
    return;
  }
  for (std::size_t i = 0; i < out.size() && i < view.alive.size(); ++i) {
    out[i].position = solver.position(m_impl->id, i).cast<float>();
    out[i].alive = view.alive[i] ? 1.0f : 0.0f;
    out[i].rotation = solver.orientation(m_impl->id, i).coeffs().cast<float>();
  }
}

std::span<const std::uint8_t> DestructibleBody::springsIntact() const {
  return m_impl->world->solver->view(m_impl->id).intact;
}
std::span<const std::uint8_t> DestructibleBody::elementsAlive() const {
  return m_impl->world->solver->view(m_impl->id).alive;
}
std::span<const std::uint32_t> DestructibleBody::fragments() const {
  return m_impl->world->solver->view(m_impl->id).fragment;
}

double DestructibleBody::elementMass() const {
  const edem::BodyView view = m_impl->world->solver->view(m_impl->id);
  double mass = 0;
  for (std::size_t i = 0; i < view.mass.size(); ++i) mass += view.alive[i] ? view.mass[i] : 0;
  return mass;
}

btVector3 DestructibleBody::linearMomentum() const {
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  if (isWhole()) return btScalar(m_impl->whole.mass) * getLinearVelocity();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < view.mass.size(); ++i)
    if (view.alive[i]) sum += view.mass[i] * solver.velocity(m_impl->id, i);
  return bullet::toBullet(sum);
}

btVector3 DestructibleBody::angularMomentum() const {
  if (isWhole()) {  // not by Bullet's inverse tensor: that of a hill has no inverse in floats
    const btMatrix3x3& turn = getWorldTransform().getBasis();
    return turn * (m_impl->whole.inertia * (getAngularVelocity() * turn));
  }
  const edem::Solver& solver = *m_impl->world->solver;
  const edem::BodyView view = solver.view(m_impl->id);
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), linear = moment, angular = moment;
  for (std::size_t i = 0; i < view.mass.size(); ++i) {
    if (!view.alive[i]) continue;
    const Eigen::Vector3d x = solver.position(m_impl->id, i),
                          p = view.mass[i] * solver.velocity(m_impl->id, i);
    mass += view.mass[i];
    moment += view.mass[i] * x;
    linear += p;
    angular += x.cross(p) + view.inertia[i] * solver.spin(m_impl->id, i);
  }
  if (mass > 0) angular -= (moment / mass).cross(linear);
  return bullet::toBullet(angular);
}

bool DestructibleBody::isWhole() const {
  return m_impl->state == Impl::State::Whole;
}

bool DestructibleBody::isAsleep() const {
  if (isWhole()) return !isActive();
  return m_impl->world->solver->view(m_impl->id).asleep;
}

RUBBLE_ABI_END
}  // namespace rubble
