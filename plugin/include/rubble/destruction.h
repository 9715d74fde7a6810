// Destructible bodies in a Bullet world. Four calls are all an application needs: construct a Destruction
// beside the world, addBody, stepSimulation as always, takeEvents. Nothing of Bullet is subclassed by the
// application, no tick callback is taken, and nothing here needs GL or CGAL.
#pragma once

#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>

#include "rubble/abi.h"
#include "rubble/asset.h"
#include "rubble/debris.h"
#include "rubble/error.h"
#include "rubble/events.h"
#include "rubble/ledger.h"
#include "rubble/material.h"
#include "rubble/pose.h"
#include "rubble/regime.h"

namespace rubble {
RUBBLE_ABI_BEGIN

class DestructibleBody;

struct DestructionDef {
  Precision precision = Precision::Float;  ///< of the elements' state
  /// Upper limit on substeps in 1/60 s. A body that needs more is refused when it is added. Contacts that
  /// need more are made softer, down to a hundredth, until they part, with a warning; elements that need more
  /// all the same stand still until the tick ends, counted in DestructionCounts::frozen; the simulation stops
  /// where those would be more than a quarter of what is awake.
  int maxSubstepsPerFrame = 20000;
  /// Share of the stable substep that is used, 0 to 1.
  double substepSafety = 0.9;
  /// False: crushed elements vanish into dust events and booked mass, no particles are kept.
  bool debris = true;
  std::uint32_t maxDebris = 100000;  ///< budget of live pieces; beyond it the oldest resting one is removed
  std::uint32_t maxEvents = 1u << 20;
  /// A fragment of at least this many elements becomes a body of its own (Events::bodiesSplit) once it is
  /// free and awake; 0: none does. Each body has arrays of all elements of its asset, so it has at least 1/64
  /// of them, too. What joints hold keeps its fragments, and of a body that no anchor holds the heaviest
  /// stays.
  std::uint32_t fragmentBodyElements = 0;
  std::uint32_t maxNewBodies = 2;  ///< of those in a tick; the others wait
  /// Whole bodies that loads or strike() hand to their elements in a tick; the others wait, in order of their
  /// ids. Those that a blow strikes cannot: without elements Bullet would have answered it for good.
  std::uint32_t maxThaws = 8;
  bool sleep = true;       ///< bodies at rest are put to sleep by Bullet's own rules
  bool breaking = true;    ///< false: springs never break (tests of stability)
  bool crushing = true;    ///< false: elements never crush
  std::uint64_t seed = 1;  ///< of the debris sizes
  LogFunction log;
};

struct DestructibleBodyDef {
  std::shared_ptr<const Asset> asset;
  Material material;
  Model model;
  /// Of the asset's frame, which starts at Asset::origin in the coordinates of the mesh: with that as its
  /// origin the solid stands where the mesh said. Places beyond limits::kPosition are refused, for the floats
  /// of the world hold no centimetres there: solids at geo-coordinates need a world whose origin is near
  /// them.
  btTransform transform = btTransform::getIdentity();
  btVector3 velocity = btVector3(0, 0, 0);  ///< of the centre of mass [m/s]
  btVector3 spin = btVector3(0, 0, 0);      ///< [rad/s]
  double massDamping = 0;  ///< decay rate of the deformation velocity [1/s]; the rigid motion is not damped
  /// Springs to the world at the asset's anchors are made, and the body is pre-stressed under the world's
  /// gravity, so that it stands still from the first step. Where that fails, a warning is logged and the body
  /// settles by itself, as every body does that only stands on something. An asset without anchors makes a
  /// free body, which is logged too. The asset may keep that state (rubble/prestress.h); where it is not this
  /// body's, it is solved anew and a warning logged.
  bool anchored = true;
  /// What the anchors hold to in place of the world: a rigid body of the world, with which they move, such as
  /// a door or a lift, or a truck: a dynamic one is pushed by them, and at least 1/50 as heavy. The body
  /// begins with its motion (`velocity` and `spin` are not looked at), does not touch it where anchors hold
  /// it, and stays elements in any regime. Once that body has left the world its anchors hold where they are.
  btRigidBody* anchorBody = nullptr;
  /// Whole, and for nothing, until something strikes it. Regime::Elements for one that is to bend and ring
  /// from the first tick on, and for the paper's letter.
  Regime regime = Regime::RigidUntilStruck;
  int collisionGroup = btBroadphaseProxy::DefaultFilter;
  int collisionMask = btBroadphaseProxy::AllFilter;
};

/// What is in the world now. Bodies that were removed no longer count, in any of these.
struct DestructionCounts {
  std::uint32_t elements = 0;       ///< of all bodies as they were added: intact + crushed
  std::uint32_t crushed = 0;        ///< of them, gone to debris and dust
  std::uint32_t awake = 0;          ///< intact elements that do not sleep
  std::uint32_t springs = 0;        ///< of all bodies as they were added, anchors too: intact + broken
  std::uint32_t springsBroken = 0;  ///< of them, those of crushed elements too
  std::uint32_t fragments = 0;      ///< sets of intact elements joined by intact springs, single ones too
  std::uint32_t debrisAlive = 0;    ///< pieces in the world
  std::uint32_t debrisSpawned = 0, debrisRemoved = 0;  ///< since the Destruction was made
  /// Elements that stood still until the tick ended, each tick's added, since the Destruction was made: no
  /// substep that maxSubstepsPerFrame allows would have been stable for them.
  std::uint32_t frozen = 0;

  std::uint32_t intact() const { return elements - crushed; }
  std::uint32_t springsIntact() const { return springs - springsBroken; }
};

/// Milliseconds of wall time since takeTimes.
struct DestructionTimes {
  double edem = 0, neighbours = 0, fracture = 0, debris = 0;
};

/// All destructible bodies of one world. Construct after the world, destroy before it. Not copyable.
class Destruction : public btActionInterface {
 public:
  explicit Destruction(btDiscreteDynamicsWorld& world, const DestructionDef& def = {});
  ~Destruction() override;
  Destruction(const Destruction&) = delete;
  Destruction& operator=(const Destruction&) = delete;

  /// Makes a body and puts it into the world. Throws rubble::Error for a bad definition, or when its stable
  /// substep would need more than maxSubstepsPerFrame. The world's usual teardown (remove and delete every
  /// object) may delete it.
  DestructibleBody* addBody(const DestructibleBodyDef& def);
  void removeBody(DestructibleBody* body);
  /// Lets the anchors of a body hold to another, from where both are; null: to the world. Throws
  /// rubble::Error for one that anchors cannot hold to, and of a body that Bullet may move as a whole: one
  /// that was added with Regime::Elements, or with an anchorBody, it never does.
  void setAnchorBody(DestructibleBody* body, btRigidBody* anchorBody);
  /// Hands a whole body to its elements in the next tick, as a blow does: for what the application alone
  /// knows of, a blast or a cut. Nothing to do for others.
  void strike(DestructibleBody* body);
  std::span<DestructibleBody* const> bodies() const;
  /// The body with that DestructibleBody::id(); null once it is removed.
  DestructibleBody* body(std::uint32_t id) const;

  /// What happened since the last call, over any number of ticks. Valid until the next call.
  const Events& takeEvents();
  /// Balances at the end of the last tick.
  const Ledger& ledger() const;
  std::span<const DebrisPiece> debris() const;
  DestructionCounts counts() const;
  DestructionTimes takeTimes();
  /// Why the simulation stopped (a state that is not finite), with the body, the tick and where it is known
  /// the element; empty while all is well. Nothing moves after it.
  const std::string& failure() const;
  /// Stable substep of the stiffest body now [s], and the substeps of the last tick.
  double stableSubstep() const;
  int lastSubsteps() const;
  /// FNV-1a over the bits of elements and springs of all bodies, and of the debris.
  std::uint64_t hash() const;
  std::uint64_t debrisHash() const;

  // btActionInterface: Bullet calls these.
  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw* drawer) override;

  struct Impl;

 private:
  friend struct ImplAccess;
  std::unique_ptr<Impl> m_impl;
};

RUBBLE_ABI_END
}  // namespace rubble

#include "rubble/destructible_body.h"
