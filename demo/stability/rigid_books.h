// What is put into rigid bodies that Bullet moves, and what they hold.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <map>
#include <vector>

namespace rubble::stability {

/// Of dynamic bodies [J].
double kineticEnergy(const std::vector<const btRigidBody*>& bodies);

/// Place and velocities.
bool isFinite(const btRigidBody& body);

/// What a kinematic body did by Bullet's contacts on those that touch it in this tick: their impulses along
/// its way [J].
double contactWork(const btRigidBody& kinematic, btDispatcher& dispatcher);

/// Work of weights and of the application's forces.
class WeightBooks {
 public:
  /// Before a tick.
  void begin(const std::vector<const btRigidBody*>& bodies);
  /// After it: what `gravity` (downwards [m/s^2]) and the forces did on those of them that began it. By their
  /// way or by their mean speed, whichever is more, for places far from the origin are rounded [J].
  double work(const std::vector<const btRigidBody*>& bodies, double gravity, double dt) const;

 private:
  struct Before {
    btVector3 at, speed, force;
  };
  std::map<const btRigidBody*, Before> m_before;
};

}  // namespace rubble::stability
