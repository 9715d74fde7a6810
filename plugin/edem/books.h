// Running sums of everything the elements exchange, so that the ledger closes. Doubles whatever the state's
// scalar.
//
// Kinetic energy is m/2 v(n-1/2) . v(n+1/2) beside U(x_n): symplectic Euler is leapfrog, and for linear
// springs this sum is exactly constant. In the same sense a force does the work h/2 F_n . v(n-1/2) before the
// instant n and h/2 F_n . v(n+1/2) after it: a Work holds back the second half until the next instant.
#pragma once

#include "edem/types.h"

namespace rubble::edem {

class Work {
 public:
  void add(double before, double after) {
    m_done += before;
    m_next += after;
  }
  void closeStep() {
    m_done += m_next;
    m_next = 0;
  }
  /// Up to the last instant at which forces were evaluated [J].
  double done() const { return m_done; }

 private:
  double m_done = 0;
  double m_next = 0;
};

/// Impulse and work of one partner (Bullet, gravity, anchors) on the elements.
struct Exchange {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [N s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< about Books::centre [N m s]
  double size = 0;                                    ///< sum of |impulse| [N s]
  Work work;                                          ///< [J]

  /// `torque` about `arm`'s end; `arm` from Books::centre.
  void push(double h, const Eigen::Vector3d& force, const Eigen::Vector3d& arm,
            const Eigen::Vector3d& torque) {
    linear += h * force;
    angular += h * (arm.cross(force) + torque);
    size += h * force.norm();
  }
};

struct Books {
  /// Reference of angular momentum: the first bodies' centre of mass.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double diagonal = 0;             ///< of the bodies when they were added [m]
  double initialMass = 0;          ///< [kg]
  double initialMomentumSize = 0;  ///< sum m |v| [kg m/s]
  Eigen::Vector3d initialLinear = Eigen::Vector3d::Zero();
  Eigen::Vector3d initialAngular = Eigen::Vector3d::Zero();
  double initialEnergy = 0;  ///< kinetic + elastic when added [J]
  Exchange bullet, gravity, anchors;
  Work dissipated;        ///< negative work of dashpots and friction on the elements [J]
  double fracture = 0;    ///< elastic energy of what broke [J]
  double massDamped = 0;  ///< kinetic energy taken by mass damping [J]
  double slept = 0;       ///< kinetic energy taken by sleep, and from frozen elements [J]
  Eigen::Vector3d sleptLinear = Eigen::Vector3d::Zero(), sleptAngular = Eigen::Vector3d::Zero();
  // What crushed and removed elements took with them.
  double leftMass = 0, leftKinetic = 0, leftElastic = 0;
  Eigen::Vector3d leftLinear = Eigen::Vector3d::Zero(), leftAngular = Eigen::Vector3d::Zero();

  // State at the last instant.
  double mass = 0, kinetic = 0, elastic = 0;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();

  void closeStep() {
    for (Exchange* e : {&bullet, &gravity, &anchors}) e->work.closeStep();
    dissipated.closeStep();
  }
};

}  // namespace rubble::edem
