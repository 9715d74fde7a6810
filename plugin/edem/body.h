// One destructible body: what never changes once it is made, its state, and the work space of a substep, each
// a struct of plain arrays and numbers of its own.
//
// Floats hold displacements, never absolute positions: at 30 GPa a float position is noise three metres from
// the origin. So every fragment has a rigid frame f (origin, turn; in double), and an element of it is where
//     x_I = origin_f + turn_f X_I + u_I,   R_I = R'_I turn_f
// with X_I its rest position about the body's centre of mass. Frames stand still during a tick; between ticks
// frames.h gives new fragments frames of their own and moves each to its fragment's best rigid motion, and
// the springs' rest vectors turn with it. A spring joins elements of one frame: one that breaks works in it
// to the end of its tick. Frame 0 is where the body was made. It never moves, but with what the anchors hold
// to (anchor_base.h), and holds what an anchor holds, and crushed elements. Positions are in double, for
// those of two frames meet in contacts. All vectors are in world axes.
#pragma once

#include <memory>
#include <vector>

#include "edem/body_constants.h"
#include "edem/body_state.h"
#include "edem/body_work.h"

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

/// Copies share their constants, and nothing else.
template <class Real>
struct Body {
  std::uint32_t id = 0;
  std::shared_ptr<const BodyConstants<Real>> constants;
  BodyState<Real> state;
  BodyWork<Real> work;

  std::size_t elementCount() const { return constants->mass.size(); }
  Eigen::Vector3d worldPosition(std::size_t i) const {
    const Frame& frame = state.frames[state.frameOf[i]];
    return frame.origin +
           (frame.turn * constants->restCentred[i] + state.displacement[i].template cast<double>());
  }
  Eigen::Quaterniond orientation(std::size_t i) const {
    return state.rotation[i].template cast<double>() * state.frames[state.frameOf[i]].turn;
  }
  SpringEnd<Real> end(std::uint32_t i) const {
    return {state.displacement[i], state.rotation[i], state.velocity[i], state.spin[i]};
  }
  /// How far from its centre a rigid body may touch an element [m].
  double reach() const {
    return constants->cells ? constants->cells->largestReach : double(constants->radius);
  }
  bool isAnchor(std::size_t spring) const { return spring >= constants->anchorBegin; }
};

/// Builds a body at rest in its frame, with its launch velocity. Throws rubble::Error naming the bad
/// constant.
template <class Real>
Body<Real> makeBody(const BodyDef& def, std::uint32_t id);

/// The far end of an anchor whose base moves.
template <class Real>
SpringEnd<Real> farEnd(const Body<Real>& body, std::size_t s) {
  const Spring<Real>& spring = body.state.springs[s];
  const FarEnds<Real>& far = body.state.farEnds;
  const Eigen::Vector3d rest =
      body.work.rest[spring.first] - (body.state.frames[0].origin - body.state.origin);
  const Vec3<Real> arm = rest.template cast<Real>() + spring.rest, moved = turned(far.turn, arm);
  return {far.shift + moved, far.turn, far.velocity + far.spin.cross(arm + moved), far.spin};
}

/// The end of spring s that is not `first`: the partner's motion, or for an anchor a fixed point or one of
/// its base.
template <class Real>
SpringEnd<Real> secondEnd(const Body<Real>& body, std::size_t s) {
  if (!body.isAnchor(s)) return body.end(body.state.springs[s].second);
  return body.state.base.given ? farEnd(body, s) : SpringEnd<Real>{};
}

/// Lists anew what is stepped: after elements fell asleep or woke, or springs broke.
template <class Real>
void listAwake(Body<Real>& body);

/// Labels connected components of the unbroken springs; returns their number.
template <class Real>
std::uint32_t labelFragments(Body<Real>& body);

}  // namespace rubble::edem
