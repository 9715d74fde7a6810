// Soft bodies at elements: contacts for Bullet's own solver of soft bodies, and what they give the elements.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>
#include <vector>

#include "bullet/thaw.h"
#include "edem/solver.h"
#include "rubble/abi.h"
#include "rubble/destructible_body.h"
#include "rubble/error.h"

class btSoftBody;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Of a soft body's nodes before Bullet's gravity of this tick [m/s].
double fastestNode(const btSoftBody& soft);
/// Its nodes that Bullet would let strike `own`, where they were before they went their way of this tick.
std::vector<StrikingPoint> strikingNodes(const btSoftBody& soft, const DestructibleBody& own);

/// Bullet solves nodes against rigid bodies, by its own law and after ours. So each node at a cell meets a
/// stand-in: it moves as the element does, is as heavy as the element's fragment, and what it is given
/// presses the element all through the next tick.
class SoftContacts {
 public:
  explicit SoftContacts(LogFunction log) : m_log(std::move(log)) {}

  /// Gives the soft body contacts at the cells of a body of elements. In the narrowphase, where Bullet does
  /// the same for rigid bodies.
  void meet(DestructibleBody& own, btSoftBody& soft, double dt);
  /// The same for one that has become elements since the narrowphase, in place of Bullet's contacts with it.
  void takeOver(DestructibleBody& own, btSoftBody& soft, double dt);
  /// Before the substeps: presses the elements with what the nodes gave in the last tick, and wakes their
  /// bodies, unless that is done.
  void deliver(edem::Solver& solver, double dt);
  /// When the elements' tick is over; Bullet solves its soft bodies after that.
  void close() { m_closed = true; }
  void forget(const DestructibleBody& body);

 private:
  struct StandIn {
    StandIn();
    btRigidBody rigid;
    DestructibleBody* own = nullptr;
    std::uint32_t element = 0;
    btVector3 begun{0, 0, 0};  // its velocity [m/s]
  };
  StandIn& next();

  LogFunction m_log;
  std::vector<std::unique_ptr<StandIn>> m_standIns;  // soft bodies point to them until their next tick
  std::size_t m_used = 0;
  bool m_closed = false;  // they are of a tick that is over
  bool m_toldOfKind = false;
  std::vector<double> m_masses;  // of the fragments, by their lowest element; scratch
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
