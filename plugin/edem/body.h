// The state of one destructible body: plain arrays, copyable, nothing but numbers.
//
// Floats hold displacements, never absolute positions: at 30 GPa a float position is noise three metres from
// the origin. So every fragment has a rigid frame f (origin, turn; in double), and an element of it is where
//     x_I = origin_f + turn_f X_I + u_I,   R_I = R'_I turn_f
// with X_I its rest position about the body's centre of mass. Frames stand still during a tick; between ticks
// frames.h gives new fragments frames of their own and moves each to its fragment's best rigid motion, and
// the springs' rest vectors turn with it. A spring joins elements of one frame: one that breaks works in it
// to the end of its tick. Frame 0 is where the body was made. It never moves and holds what an anchor holds,
// and crushed elements. Positions are in double, for those of two frames meet in contacts. All vectors are in
// world axes.
#pragma once

#include <memory>
#include <vector>

#include "edem/cell_faces.h"
#include "edem/contact.h"
#include "edem/criterion.h"
#include "edem/spring.h"
#include "edem/types.h"
#include "rubble/asset.h"
#include "rubble/events.h"
#include "rubble/material.h"

namespace rubble::edem {

/// How a body is made. The asset's frame is put at `transform`; velocity and spin are of the whole body.
struct BodyDef {
  std::shared_ptr<const Asset> asset;
  Material material;
  Model model;
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the centre of mass [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]
  double massDamping = 0;                              ///< of the deformation velocity [1/s]
  bool anchored = true;                                ///< use the asset's anchors
  /// Fracture energy W_I at which element I is crushed [J] (n); empty: never.
  std::vector<double> crushEnergy;
};

/// A pair of elements whose contact distance is not simply 2 r: joined by a spring, or overlapping at rest.
struct PairIndex {
  std::uint32_t partner;
  std::uint32_t pair;  ///< into Body::range; below springs.size() a spring's pair
};

inline constexpr std::uint32_t kNoPair = 0xffffffffu;

/// Rigid motion of one fragment, and what its contacts do to it in this substep (fragment_motion.h).
struct FragmentMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass, world [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of it [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]
  double inverseMass = 0;                              ///< 0 where an anchor holds it [1/kg]
  Eigen::Matrix3d inverseInertia = Eigen::Matrix3d::Zero();
  bool fixed = false;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about the centre [N m]
  double pressing = 0;                               ///< sum of the sizes of its contacts' forces [N]
  double pressed = 0;                                ///< the same in the last substep [N]

  Eigen::Vector3d velocityAt(const Eigen::Vector3d& world) const {
    return velocity + spin.cross(world - centre);
  }
};

/// A rigid motion that displacements are from.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

template <class Real>
struct Body {
  std::uint32_t id = 0;
  std::shared_ptr<const Asset> asset;
  Material material;
  Model model;
  double massDamping = 0;  ///< of the deformation velocity [1/s]
  /// The same in every substep, until another spring breaks: while the host lets it bend to a load [1/s].
  double easeDamping = 0;
  std::uint32_t easeBroken = 0;  ///< brokenCount when that began

  // Constants of the elements.
  std::vector<double> mass;  ///< density x volume of the cell [kg]
  std::vector<Real> inverseMass;
  std::vector<double> inertia;  ///< scalar moment [kg m^2]
  std::vector<Real> inverseInertia;
  std::vector<Eigen::Vector3d> restCentred;  ///< X_I: rest positions about the centre of mass, asset axes [m]
  std::vector<Real> crushEnergy;             ///< W_I above which I is crushed [J], from eq. (4)

  // Springs, then anchors. An anchor's far end is a fixed point.
  std::vector<Spring<Real>> springs;
  std::vector<Eigen::Vector3d> springRest;    ///< d0, asset axes [m]
  std::vector<Eigen::Vector3d> springOffset;  ///< from the middle of d0 to where they act, asset axes [m]
  std::size_t anchorBegin = 0;                ///< springs[anchorBegin..] are anchors
  std::vector<std::uint32_t> springOffsets;   ///< CSR: the springs and anchors of each element
  std::vector<std::uint32_t> springsOf;
  std::vector<std::uint32_t> pairOffsets;  ///< CSR: partners of each element, sorted by partner
  std::vector<PairIndex> pairs;
  Criterion<Real> criterion{};
  ContactSide contact;  ///< of an element of mean mass; k_n = contactStiffness E h
  Real radius = 0;
  /// What rigid bodies touch; none: the elements' spheres.
  std::shared_ptr<const CellFaces> cells;

  // Frame 0, constant; `position` and `rest` are relative to this origin.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();

  // State.
  std::vector<Frame> frames;             ///< frame 0, then one of each fragment without anchors
  std::vector<std::uint32_t> frameOf;    ///< each element's, into `frames`
  std::vector<Vec3<Real>> displacement;  ///< u_I [m]
  std::vector<Quat<Real>> rotation;      ///< R'_I
  std::vector<Vec3<Real>> velocity;      ///< at the half step before the positions [m/s]
  /// What float addition lost of velocity (compensated summation) [m/s].
  std::vector<Vec3<Real>> velocityCarry;
  std::vector<Vec3<Real>> spin;  ///< [rad/s]
  std::vector<std::uint8_t> alive;
  std::vector<std::uint8_t> intact;         ///< springs, then anchors
  Exposure exposure;                        ///< of `cells`
  std::vector<Real> range;                  ///< D of each pair [m]
  std::vector<std::uint16_t> touchesBegun;  ///< at each element since the substep was chosen
  std::vector<FragmentMotion> motions;      ///< of the fragments
  std::vector<std::uint32_t> motionOf;      ///< each element's place in `motions`
  std::vector<std::uint8_t> anchored;       ///< 1 while an anchor carries the element
  /// Lowest element connected with I through springs; kNoElement if crushed.
  std::vector<std::uint32_t> fragment;
  std::uint32_t fragmentCount = 0;
  std::uint32_t crushedCount = 0;
  std::uint32_t brokenCount = 0;
  std::uint32_t labelledBroken = 0;  ///< brokenCount when the fragments were labelled
  std::uint32_t anchorsIntact = 0;
  std::vector<std::uint8_t> sleeping;  ///< elements of fragments that sleep by themselves, see sleep.h
  /// How long each element has been slower than SolverDef::sleepSpeed, and than settleSpeed [s].
  std::vector<float> calmTime, slowTime;
  /// Its largest speed in slowTime [m/s], and whether it has been half as fast since.
  std::vector<float> slowPeak;
  std::vector<std::uint8_t> slowTurned;
  std::uint32_t sleepingCount = 0;
  double energyAsleep = 0;  ///< in the springs of those [J]
  double massAsleep = 0;    ///< of those [kg]
  bool asleep = false;      ///< all of it, by its host
  bool parked = false;      ///< lent to the host, asleep too (parking.h)
  /// Displacements and rotations in which a body that an anchor holds is parked; empty: none [m].
  std::vector<Vec3<Real>> parkedAt;
  std::vector<Quat<Real>> parkedTurn;
  double sleepingElastic = 0;  ///< in its springs and own contacts when it fell asleep [J]

  // What is stepped, in rising order; written by listAwake. Elements that were crushed and springs that broke
  // since may be in them.
  std::vector<std::uint32_t> awake;         ///< elements that live and do not sleep
  std::vector<std::uint32_t> awakeSprings;  ///< unbroken springs and anchors of those

  // Derived from the frames; written by turnRest.
  std::vector<Vec3<double>> rest;  ///< origin_f + turn_f X_I, relative to origin [m]

  // Work space of a substep.
  std::vector<Vec3<double>> position;                   ///< rest + u, relative to origin [m]
  std::vector<Vec3<Real>> force, torque;                ///< all [N], [N m]
  std::vector<Vec3<Real>> dampingForce, dampingTorque;  ///< the part of force and torque that is lost energy
  std::vector<Real> load;                               ///< W_I, eq. (3) [J]
  std::vector<std::uint32_t> overloaded;                ///< springs to break in this substep
  std::vector<BreakMode> overloadMode;                  ///< why, beside `overloaded`
  std::vector<std::uint32_t> crushing;                  ///< elements that leave at the end of this substep
  std::vector<std::uint8_t> leaving;                    ///< 1 for those
  std::vector<std::uint8_t> springListed;               ///< marks of markCrushed; all 0 between calls

  std::size_t elementCount() const { return mass.size(); }
  Eigen::Vector3d worldPosition(std::size_t i) const {
    const Frame& frame = frames[frameOf[i]];
    return frame.origin + (frame.turn * restCentred[i] + displacement[i].template cast<double>());
  }
  Eigen::Quaterniond orientation(std::size_t i) const {
    return rotation[i].template cast<double>() * frames[frameOf[i]].turn;
  }
  SpringEnd<Real> end(std::uint32_t i) const { return {displacement[i], rotation[i], velocity[i], spin[i]}; }
  /// How far from its centre a rigid body may touch an element [m].
  double reach() const { return cells ? cells->largestReach : double(radius); }
  bool isAnchor(std::size_t spring) const { return spring >= anchorBegin; }
};

/// Builds a body at rest in its frame, with its launch velocity. Throws rubble::Error naming the bad
/// constant.
template <class Real>
Body<Real> makeBody(const BodyDef& def, std::uint32_t id);

/// The end of spring s that is not `first`: the partner's motion, or a fixed point for an anchor.
template <class Real>
SpringEnd<Real> secondEnd(const Body<Real>& body, std::size_t s) {
  return body.isAnchor(s) ? SpringEnd<Real>{} : body.end(body.springs[s].second);
}

/// Lists anew what is stepped: after elements fell asleep or woke, or springs broke.
template <class Real>
void listAwake(Body<Real>& body);

/// Labels connected components of the unbroken springs; returns their number.
template <class Real>
std::uint32_t labelFragments(Body<Real>& body);

extern template struct Body<float>;
extern template struct Body<double>;

}  // namespace rubble::edem
