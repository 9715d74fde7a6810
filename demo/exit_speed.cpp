#include "demo/exit_speed.h"

#include <vector>

#include "demo/bullet_eigen.h"
#include "demo/world.h"

namespace rubble::demo {

ExitSpeed::ExitSpeed(const World& world) {
  if (world.impactors().empty()) return;
  const btVector3 velocity = world.impactors().front()->getLinearVelocity();
  if (velocity.length2() > 0) m_direction = velocity.normalized();
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
  btVector3 low, high;
  impactor.getAabb(low, high);
  const bool inside = m_objects.intersects(Eigen::AlignedBox3f(toEigen(low), toEigen(high)));
  m_left = !inside && m_speed.has_value();
  if (inside || m_left) m_speed = double(impactor.getLinearVelocity().dot(m_direction));
}

}  // namespace rubble::demo
