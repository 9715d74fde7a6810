// The contact of two elements, or of an element and a rigid surface (paper 3.1.2), with a memory.
//
//   F_n = k_n overlap - eta_n v_n
//   F_t = -k_t xi - eta_t v_t,       |F_t| <= mu F_n       xi: what slid since they touched, less what
//   slipped M   = -k_r theta - eta_r w,      |M| <= mu_r R F_n     theta: what rolled and twisted, less what
//   gave way
//
// DEVIATION: the paper has F_n and F_t = -eta_t v_t alone. Its dashpot may pull (here F_n >= 0) and knows no
// limit (mu < 0), and without xi and theta [Cundall79, Luding08] nothing stands on a slope and spheres roll
// for ever. A law without memory has k_t = k_r = 0.
//
// - [Cundall79] Cundall, Strack: A discrete numerical model for granular assemblies. Geotechnique 29, 1979.
// - [Luding08] Luding: Cohesive, frictional powders: contact models for tension. Granular Matter 10, 2008.
#pragma once

#include <cassert>
#include <cmath>

#include "edem/types.h"

namespace rubble::edem {

template <class Real>
struct ContactLaw {
  Real stiffness = 0;          ///< k_n [N/m]
  Real damping = 0;            ///< eta_n [N s/m]
  Real tangential = 0;         ///< k_t [N/m]
  Real tangentialDamping = 0;  ///< eta_t [N s/m]
  Real rolling = 0;            ///< k_r [N m]
  Real rollingDamping = 0;     ///< eta_r [N m s]
  Real rollingReach = 0;       ///< mu_r R [m]
  Real friction = 0;           ///< mu; negative: unlimited
  Real inelastic = 0;          ///< 1 - e^2: share of the normal force withheld while the bodies part

  template <class Other>
  ContactLaw<Other> cast() const {
    return {Other(stiffness),         Other(damping),  Other(tangential),
            Other(tangentialDamping), Other(rolling),  Other(rollingDamping),
            Other(rollingReach),      Other(friction), Other(inelastic)};
  }
};

/// What a touching pair remembers; world axes.
template <class Real>
struct ContactMemory {
  Vec3<Real> slip = Vec3<Real>::Zero();  ///< xi, of the second along the first [m]
  Vec3<Real> roll = Vec3<Real>::Zero();  ///< theta, of the second against the first [rad]
  /// Distance at which the two touch, where that is not the sum of their radii: they were first seen deeper
  /// in each other. Grows with their distance; 0 while they are out of reach [m].
  Real range = 0;
  Real energy = 0;  ///< in its springs at the last instant [J]
  Real onset = 1;   ///< share of the step before, in the first that they touch: of it they touched in
};

/// Forgets what slid and rolled.
template <class Real>
void part(ContactMemory<Real>& memory) {
  memory.slip.setZero();
  memory.roll.setZero();
}

/// The range of two bodies at `distance` that may touch at `free` at most and near each other at `speed`.
/// What they cannot have come in the last step of `moved` seconds they were in each other before anyone
/// looked: no force drives them apart for it.
template <class Real>
Real contactRange(Real range, Real distance, Real free, Real speed, Real moved) {
  if (range <= Real(0)) range = distance + Real(2) * moved * speed;
  return std::fmin(std::fmax(range, distance), free);
}

/// A contact whose bodies near each other by `way` in a step, to `overlap`, while it withholds a share of its
/// force: the spring is pressed by the share that they feel and gives way by the rest. Else it would hold,
/// and give back once nothing is withheld, what nobody has put into it.
template <class Real>
struct ContactYield {
  Real yielded = 0;  ///< to be taken off the overlap [m]
  Real lost = 0;     ///< by the spring; the withheld force has it as gained [J]

  ContactYield(Real stiffness, Real overlap, Real way, Real withheld) {
    if (!(withheld > Real(0)) || !(way > Real(0)) || !(overlap > Real(0))) return;
    const Real before = std::fmax(Real(0), overlap - way);
    yielded = withheld * (overlap - before);
    // What leapfrog's half forces do on the way, less what the spring then holds.
    lost = Real(0.5) * stiffness * yielded * (overlap - yielded + before);
  }
};

/// Lengths of the steps before and after an instant [s].
struct Steps {
  double moved;  ///< that brought the bodies here
  double next;
};

/// How two bodies touch now. `normal` points from the first to the second (unit); the rest is of the second
/// relative to the first.
template <class Real>
struct ContactMotion {
  Real overlap = 0;     ///< 0 where all of it gave way [m]
  Real share = 1;       ///< of the normal spring's force, see touchShare
  Real withheld = 0;    ///< share of the normal force, see withheld in fragment_motion.h
  Vec3<Real> normal;    ///< unit
  Vec3<Real> approach;  ///< velocity at the contact point [m/s]
  Vec3<Real> spin;      ///< [rad/s]
};

/// Share of the normal spring's force in this substep. A force acts for half of the step before and half of
/// the step after its instant; in the step in which the two met, and in that in which they will part, they
/// touch for a part only. Without it each meeting loses and each parting gains k (h v)^2 / 12 on average.
/// `speed` is that of closing [m/s], `step` the length of both steps [s].
template <class Real>
Real touchShare(Real overlap, Real speed, Real step, Real onset) {
  const Real way = step * std::abs(speed);
  const Real parting = speed < Real(0) && overlap < way ? overlap / way : Real(1);
  return Real(0.5) * (onset + parting);
}

/// The part of the step before in which two bodies touched that touch for the first time now.
template <class Real>
Real onsetShare(Real overlap, Real speed, Real step) {
  const Real way = step * speed;
  return overlap < way ? overlap / way : Real(1);
}

/// Force and torque on the second body, split into what energy gives back and what is lost.
template <class Real>
struct ContactLoad {
  Vec3<Real> elastic, damping;              ///< [N]
  Vec3<Real> elasticTorque, dampingTorque;  ///< beside that of the arms [N m]
  Real full = 0;                            ///< normal force before any is withheld [N]
  Real energy = 0;                          ///< in the three springs [J]
  Real slipped = 0;                         ///< lost by sliding and giving way since the last step [J]
};

/// A spring and a dashpot whose sum may not pass a limit: the spring gives way first.
template <class Real>
struct LimitedSpring {
  Vec3<Real> elastic, damping;
  Real energy, slipped;

  /// `stretch` is advanced by `moved` seconds at `rate`; limit < 0: none.
  LimitedSpring(Real stiffness, Real dashpot, Real limit, const Vec3<Real>& rate, Real moved,
                Vec3<Real>& stretch) {
    const Vec3<Real> before = stretch;
    stretch += moved * rate;
    elastic = -stiffness * stretch;
    slipped = 0;
    if (limit >= Real(0)) {
      const Real size2 = elastic.squaredNorm();
      if (size2 > limit * limit) {
        const Vec3<Real> wanted = stretch;
        const Real share = limit / std::sqrt(size2);
        stretch *= share;
        elastic *= share;
        // What leapfrog's half forces do on the way, less what the spring then holds.
        slipped = Real(0.5) * stiffness * (wanted - stretch).dot(before + stretch);
      }
    }
    damping = -dashpot * rate;
    if (limit >= Real(0)) {
      const Vec3<Real> all = elastic + damping;
      const Real size2 = all.squaredNorm();
      if (size2 > limit * limit) damping = all * (limit / std::sqrt(size2)) - elastic;
    }
    energy = Real(0.5) * stiffness * stretch.squaredNorm();
  }
};

/// Sliding and rolling under the normal force `total` [N]: without it, its load and its energy. `reach` times
/// that force is the torque that gives way [m]; negative: none does.
template <class Real>
ContactLoad<Real> slidingLoad(const ContactLaw<Real>& law, const ContactMotion<Real>& motion, Real total,
                              Real reach, Real moved, ContactMemory<Real>& memory) {
  const Vec3<Real>& normal = motion.normal;
  // The tangent plane has turned since: xi turns with it and keeps its length.
  const Real size2 = memory.slip.squaredNorm();
  if (size2 > Real(0)) {
    memory.slip -= memory.slip.dot(normal) * normal;
    const Real left2 = memory.slip.squaredNorm();
    if (left2 > Real(0)) memory.slip *= std::sqrt(size2 / left2);
  }
  const Vec3<Real> sliding = motion.approach - motion.approach.dot(normal) * normal;
  const Real limit = law.friction >= Real(0) ? law.friction * total : Real(-1);
  const LimitedSpring<Real> slide(law.tangential, law.tangentialDamping, limit, sliding, moved, memory.slip);
  ContactLoad<Real> load;
  load.elastic = slide.elastic;
  load.damping = slide.damping;
  load.energy = slide.energy;
  load.slipped = slide.slipped;
  load.elasticTorque.setZero();
  load.dampingTorque.setZero();
  if (law.rolling > Real(0)) {
    const LimitedSpring<Real> roll(law.rolling, law.rollingDamping, reach < Real(0) ? reach : reach * total,
                                   motion.spin, moved, memory.roll);
    load.elasticTorque = roll.elastic;
    load.dampingTorque = roll.damping;
    load.energy += roll.energy;
    load.slipped += roll.slipped;
  }
  return load;
}

/// Load of a contact. The memory is advanced by `moved`, the length of the step that brought the bodies here
/// [s]; with 0 the same load comes again.
template <class Real>
ContactLoad<Real> contactLoad(const ContactLaw<Real>& law, const ContactMotion<Real>& motion, Real moved,
                              ContactMemory<Real>& memory) {
  assert(motion.overlap >= 0 && law.stiffness >= 0 && law.damping >= 0 && moved >= 0);
  assert(std::abs(motion.normal.squaredNorm() - Real(1)) < Real(1e-3));  // looser than any scalar's rounding
  const Vec3<Real>& normal = motion.normal;
  const Real pushed = law.stiffness * motion.overlap * motion.share;
  const Real normalSpeed = motion.approach.dot(normal);
  const Real full = std::fmax(Real(0), pushed - law.damping * normalSpeed);
  const Real total = (Real(1) - motion.withheld) * full;

  ContactLoad<Real> load = slidingLoad(law, motion, total, law.rollingReach, moved, memory);
  load.elastic += pushed * normal;
  load.damping += (total - pushed) * normal;
  load.full = full;
  load.energy += Real(0.5) * law.stiffness * motion.overlap * motion.overlap;
  return load;
}

/// What the springs for sliding and rolling still held when two bodies parted, and did on the way since the
/// last instant: it is lost [J].
template <class Real>
Real lostAtParting(const ContactLaw<Real>& law, const Vec3<Real>& approach, const Vec3<Real>& spin,
                   Real moved, const ContactMemory<Real>& memory) {
  return Real(0.5) * (law.tangential * memory.slip.dot(memory.slip + moved * approach) +
                      law.rolling * memory.roll.dot(memory.roll + moved * spin));
}

/// Dashpot constant with the damping ratio `ratio` for the spring `stiffness` between masses of reduced mass
/// `mass`.
template <class Real>
Real dashpot(Real ratio, Real stiffness, Real mass) {
  return Real(2) * ratio * std::sqrt(stiffness * mass);
}

/// One side of a contact, as its law needs it.
struct ContactSide {
  double stiffness = 0;        ///< of a contact with its like [N/m]
  double mobility = 0;         ///< 1 / mass; 0: does not move [1/kg]
  double turning = 0;          ///< r^2 / inertia [1/kg]
  double radius = 0;           ///< of curvature; 0: flat [m]
  double damping = 0;          ///< ratio
  double friction = 0;         ///< negative: unlimited
  double rollingFriction = 0;  ///< mu_r
  double restitution = 0;      ///< that of a contact is the product of both sides', as Bullet has it
  bool memory = true;          ///< false: the paper
};

/// Law of two sides of a contact: their springs in series, twice as stiff each as a contact with its like.
ContactLaw<double> contactLaw(const ContactSide& a, const ContactSide& b);

}  // namespace rubble::edem
