// What the application does in the middle of a case.
#include <limits>

#include "bullet/convert.h"
#include "demo/stability/case_world.h"

namespace rubble::stability {

using bullet::toBullet;

void CaseWorld::happen() {
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  switch (m_case.happening) {
    case Happening::None:
      return;
    case Happening::Pause:
      for (int i = 0; i < 3; ++i) m_bullet.world.stepSimulation(0, 1, btScalar(m_case.frameStep));
      return;
    case Happening::RemoveBody:
      removeBody();
      return;
    case Happening::Strike:
      if (m_bullet.destruction) m_bullet.destruction->strike(m_bullet.destruction->bodies().front());
      return;
    case Happening::NaNOnBody:
      bodies().front()->setLinearVelocity({nan, 0, 0});
      m_bodySpoiled = true;
      return;
    default:
      break;
  }
  if (!m_impactor) return;
  const btScalar mass = m_impactor->getInvMass() > 0 ? 1 / m_impactor->getInvMass() : 0;
  btTransform at = m_impactor->getWorldTransform();
  switch (m_case.happening) {
    case Happening::TeleportImpactor:
      at.setOrigin(toBullet(m_middle));
      m_impactor->setWorldTransform(at);
      break;
    case Happening::RemoveImpactor:
      m_bullet.remove(m_impactor);
      m_impactor = nullptr;
      break;
    case Happening::HugeForce:
      m_impactor->applyCentralForce({0, btScalar(-1e7) * mass, 0});
      break;
    case Happening::NaNVelocity:
      m_impactor->setLinearVelocity({nan, 0, 0});
      m_spoiled = true;
      break;
    case Happening::NaNPlace:
      at.setOrigin({nan, 0, 0});
      m_impactor->setWorldTransform(at);
      m_spoiled = true;
      break;
    case Happening::InfiniteForce:
      m_impactor->applyCentralForce({0, 0, std::numeric_limits<btScalar>::infinity()});
      m_spoiled = true;
      break;
    default:
      break;
  }
}

void CaseWorld::removeBody() {
  if (m_bullet.destruction) return m_bullet.destruction->removeBody(m_bullet.destruction->bodies().front());
  m_bullet.remove(m_stock.front());
  m_stock.erase(m_stock.begin());
}

}  // namespace rubble::stability
