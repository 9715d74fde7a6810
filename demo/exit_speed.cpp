#include "demo/exit_speed.h"

#include <vector>

#include "demo/bullet_eigen.h"
#include "demo/world.h"

namespace rubble::demo {

namespace {

Eigen::AlignedBox3f boxOf(const btRigidBody& body) {
  btVector3 low, high;
  body.getAabb(low, high);
  return {toEigen(low), toEigen(high)};
}

}  // namespace

ExitSpeed::ExitSpeed(const World& world) {
  if (world.impactors().empty()) return;
  const btVector3 velocity = world.impactors().front()->getLinearVelocity();
  if (velocity.length2() > 0) m_direction = velocity.normalized();
  m_last = boxOf(*world.impactors().front());
  std::vector<ElementPose> poses;
  for (const DestructibleBody* body : world.destruction().bodies()) {
    poses.resize(body->asset()->elementCount());
    body->poses(poses);
    const Eigen::Vector3f radius = Eigen::Vector3f::Constant(float(body->asset()->radius));
    for (const ElementPose& pose : poses) {
      m_objects.extend(pose.position - radius);
      m_objects.extend(pose.position + radius);
    }
  }
}

void ExitSpeed::update(const World& world) {
  if (m_left || world.impactors().empty()) return;
  const btRigidBody& impactor = *world.impactors().front();
  const Eigen::AlignedBox3f now = boxOf(impactor);
  const bool inside = m_objects.intersects(now);
  // A fast one is in front of the objects in one frame and behind them in the next.
  const bool passed = m_objects.intersects(m_last.merged(now));
  m_last = now;
  m_left = !inside && (m_speed.has_value() || passed);
  if (inside || m_left) m_speed = double(impactor.getLinearVelocity().dot(m_direction));
}

}  // namespace rubble::demo
