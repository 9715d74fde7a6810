// One tick of all destructible bodies of a world: who is near, substeps, impulses back, and after Bullet
// moved things the debris, the ledger and the events.
#pragma once

#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "bullet/body_impl.h"
#include "bullet/debris_surroundings.h"
#include "bullet/element_algorithm.h"
#include "bullet/energy_alarm.h"
#include "bullet/energy_balance.h"
#include "bullet/joints.h"
#include "bullet/ledger_book.h"
#include "bullet/push_out.h"
#include "bullet/rigid_proxies.h"
#include "bullet/soft_contacts.h"
#include "bullet/tick_state.h"
#include "bullet/whole_shapes.h"
#include "debris/debris_system.h"
#include "edem/solver.h"
#include "rubble/destruction.h"

namespace rubble {
RUBBLE_ABI_BEGIN

struct Destruction::Impl {
  Impl(btDiscreteDynamicsWorld& bulletWorld, const DestructionDef& definition);
  ~Impl();

  DestructibleBody* addBody(const DestructibleBodyDef& def);
  /// Ties its anchors to `base` with the motion that they have of it now; null: to the world.
  void setAnchorBody(DestructibleBody& body, btRigidBody* base, const edem::Twist& motion);
  /// The body is being deleted, by us or by the application.
  void forget(DestructibleBody& body);

  /// Substeps, once a tick: from the first coupler, or from the action when Bullet called none.
  void advance(double dt);
  /// What lies on a body that is about to leave falls.
  void wakeTouching(const DestructibleBody& body);
  /// After Bullet moved its bodies.
  void finish(double dt);
  /// The narrowphase is about to look at the two, in this tick or for a query.
  void meet(DestructibleBody& body, const btCollisionObject& other);
  /// Puts the body's coupler into Bullet's world.
  void couple(DestructibleBody& body);
  /// Puts the elements of whole bodies where Bullet has these, for who reads them.
  void placeWholes();
  /// Null: none has that id.
  DestructibleBody* bodyOf(std::uint32_t id) const;

  btDiscreteDynamicsWorld& world;
  DestructionDef def;
  std::unique_ptr<edem::Solver> solver;
  std::unique_ptr<debris::DebrisSystem> debrisSystem;  ///< null when debris are switched off
  bullet::ElementAlgorithms algorithms;
  bullet::RigidProxies proxyMaker;
  std::unique_ptr<bullet::DebrisSurroundings> surroundings;
  std::vector<DestructibleBody*> bodies;
  std::vector<bullet::TouchedBody> touched;
  std::vector<edem::RigidProxy> proxies;              ///< beside `touched`
  std::vector<bullet::Reaction> reactions;            ///< of the last tick
  std::vector<bullet::LeftPlace> leftPlaces;          ///< of what was touched in the last tick
  std::vector<bullet::HeldJoint> joints, lastJoints;  ///< the application's, to bodies of elements
  bullet::SoftContacts softContacts;
  bool begun = false;     ///< this tick: some coupler or the action has come
  bool advanced = false;  ///< in this tick
  bullet::LedgerBook ledgerBook;
  bullet::EnergyAlarm energyAlarm;
  Events events[2];
  int filling = 0;
  DestructionTimes times;
  std::string failure;
  bool warned = false;  ///< of a tick that could not be followed; once is enough
  int substeps = 0;
  std::uint64_t ticks = 0;  ///< that are over, and their time [s]
  double seconds = 0;
  bullet::WholeShapes wholeShapes;
  std::vector<DestructibleBody*> wholeBodies, elementBodies;  ///< `bodies` by who moves them
  std::vector<DestructibleBody*> unsettledWholes;             ///< whose loads each tick looks at
  std::vector<DestructibleBody*> lookedWholes;                ///< scratch of the tick's end
  bool hasDebris = false;                                     ///< when the last tick ended
  bool ledgerStale = false;  ///< something has been booked since it was closed
  int coupledWholes = 0;     ///< whole bodies whose coupler is in the world
  std::mutex meeting;        ///< for these and the world's constraints, in the narrowphase
  std::uint32_t crushed = 0, debrisSpawned = 0, debrisRemoved = 0, frozen = 0;
  debris::DebrisBatch batch;
  std::vector<Eigen::AlignedBox3d> wakeBoxes;
  std::vector<bullet::FragmentSize> fragmentSizes;  ///< scratch
  bullet::EnergyBalance energyBalance;
  bullet::PushOut pushOut;

 private:
  void logRefusedRest(std::uint32_t id, const std::string& name) const;
  void logPrestress(std::uint32_t id, const std::string& name, const DestructibleBodyDef& bodyDef) const;
  void gatherProxies(double dt);
  bool isTouched(const btCollisionObject& object) const;
  void addProxy(btCollisionObject& object, const DestructibleBody* beside, bool bears, double dt,
                std::span<const Eigen::AlignedBox3d> boxes);
  void gatherSupports(double dt, std::span<const Eigen::AlignedBox3d> boxes);
  void spareFiltered();
  void bearAnchored();
  /// Tells the anchors where the bodies that they hold to will be.
  void carryAnchored(double dt);
  void rideAnchored(DestructibleBody& body);
  double speedOn(const btCollisionObject& object, const DestructibleBody& own) const;
  /// What rides on a body of Bullet's and that fall asleep in the same tick.
  void waitForAnchored();
  void followElements();
  void forgetTaken();
  void lateImpulses();
  void coupleLinks();
  void cleanPairs(DestructibleBody& body);
  void giveBodies(double dt, std::span<const edem::RigidProxy> start);
  void giveLinks(double dt, std::span<const edem::RigidProxy> start);
  void fixPositions();
  void noteReactions(double dt);
  bool isHeld(const btCollisionObject& body) const;
  void noteLeftPlaces();
  /// Since the last tick, by its transform.
  bool wasPlaced(const btCollisionObject& body) const;
  void writeAppliedImpulses();
  void bookEvents();
  void breakElements();
  /// Makes bodies of fragments that have come free.
  void splitBodies();
  std::vector<std::uint32_t> fragmentsToSplit(const DestructibleBody& body);
  void splitBody(DestructibleBody& body, std::uint32_t root);
  /// Of what a new body has of its own; its id is the solver's. And puts it into the world.
  DestructibleBody* make(std::unique_ptr<DestructibleBody::Impl> impl, double mass);
  void enter(DestructibleBody& body, int group, int mask);
  void failSolver();
  /// Ends the simulation where a whole body's place or motion in Bullet is not finite.
  void failSpoiled(std::span<DestructibleBody* const> looked);
  /// Takes what the application has set of bodies that their elements move, and shows it what they do.
  void takeHostMoves(double dt);
  std::optional<btVector3> takeGravity(DestructibleBody& body);
  void showElements();
  void showElements(DestructibleBody& body);
  btTransform placeOfShown(DestructibleBody& body, const edem::RigidMotion& motion) const;
  void gatherJoints();
  void loadJoints(double dt);
  void poseJoints(double dt);
  void takeJoints(double dt);
  bool hasJoint(const btTypedConstraint* joint) const;
  void forgetJointsOf(const DestructibleBody& body);
  void takeFragment(DestructibleBody& body);
  void chooseFragment(DestructibleBody& body);
  void moveJointFrames(DestructibleBody& body, const btTransform& by);
  btTransform placeForJoints(const DestructibleBody& body, double dt) const;
  void pushJointed(DestructibleBody& body, double dt);
  bullet::JointImpulse jointWrench(const DestructibleBody& body, const edem::RigidMotion& motion) const;
  void closeLedger(double dt);
  /// Ends the simulation when what should take energy makes more than was put in.
  void judgeDamping();
  /// Or when elements hold more than was put in, whatever made it.
  void judgeBalance();
  double roundedEnergy() const;  ///< [J]
  const DestructibleBody& fastest() const;
  void fail(const DestructibleBody& body, const std::string& what);
  std::string whenText() const;  ///< of a failure: which tick
  void stepDebris(double dt);
  /// Lends a new body to Bullet, if it may be.
  void beWhole(DestructibleBody& body, const DestructibleBodyDef& bodyDef);
  void placeWhole(DestructibleBody& body);
  bool isStruck(DestructibleBody& body, btCollisionObject& other, double dt);
  void thawStruck(double dt);
  void thaw(DestructibleBody& body, double dt);
  /// Looks at the loads that rest on whole bodies; those that may break them thaw in the next tick.
  void noteLoads(double dt);
  /// Which whole bodies the tick's end looks at.
  void gatherLooked(double dt);
  void sumPressures();
  void gatherPatches(double dt);
  void finishThaws();
  /// Of a body that has thawed under a load: lets it bend to it without a swing; later, after `dt` of it.
  void beginEasing(DestructibleBody& body);
  void ease(DestructibleBody& body, double dt);
  bool mayMatter(const DestructibleBody& body, const btCollisionObject& other) const;
  void uncouple(DestructibleBody& body);
  /// Those of whole bodies that nothing has met for long.
  void uncoupleIdle();
  void enlist(DestructibleBody& body);
  void delist(DestructibleBody& body);
  /// Of a body that is listed.
  void setState(DestructibleBody& body, DestructibleBody::Impl::State state);
  /// Lends bodies that have been calm for long enough to Bullet again.
  void freezeCalm(double dt);
  void freeze(DestructibleBody& body);
  void followSleep();
  void updateSleep(double dt);
  template <class T>
  void record(std::vector<T>& list, const T& event);

  // Elements slower than this, and their surfaces, count as still for Bullet's own rules of sleep [m/s].
  static constexpr double kQuietSpeed = 0.01;
};

template <class T>
void Destruction::Impl::record(std::vector<T>& list, const T& event) {
  if (list.size() < def.maxEvents) {
    list.push_back(event);
  } else {
    ++events[filling].dropped;
  }
}

RUBBLE_ABI_END
}  // namespace rubble
