// The plain explicit EDEM solver: all bodies of one world, advanced a tick at a time. It stays as the
// reference of faster ones. `Solver` hides the scalar; SolverOf<float> and SolverOf<double> are the same
// source.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "edem/body.h"
#include "edem/books.h"
#include "edem/calm.h"
#include "edem/parking.h"
#include "edem/rigid_motion.h"
#include "edem/rigid_proxy.h"
#include "edem/solver_def.h"
#include "edem/stages.h"
#include "edem/static_rest.h"

namespace rubble::edem {

/// Motion and shape of one body for its host, world frame, SI.
struct BodyView {
  std::span<const std::uint8_t> alive;
  std::span<const std::uint8_t> intact;  ///< springs, then anchors
  std::span<const std::uint32_t> fragment;
  std::span<const double> mass;
  std::span<const double> inertia;         ///< scalar moments [kg m^2]
  std::span<const std::uint8_t> sleeping;  ///< elements that lie still, while the body does not sleep
  std::uint32_t fragments = 0, crushed = 0, broken = 0;
  bool asleep = false;
  std::uint32_t sleepingCount = 0;
  std::uint32_t anchorsIntact = 0;
  std::uint64_t sleepChanges = 0;                       ///< counts on whenever other elements may sleep
  std::uint32_t absentElements = 0, absentSprings = 0;  ///< other bodies have them, see Solver::split

  /// Elements and springs that are its own, crushed and broken ones too.
  std::uint32_t elements() const { return std::uint32_t(alive.size()) - absentElements; }
  std::uint32_t springs() const { return std::uint32_t(intact.size()) - absentSprings; }
  /// Nothing of it moves.
  bool lies() const { return asleep || sleepingCount + crushed == elements(); }
};

class Solver {
 public:
  /// Throws rubble::Error naming a bad value of the definition.
  static std::unique_ptr<Solver> make(Precision precision, const SolverDef& def);
  virtual ~Solver() = default;

  /// Adds a body; an anchored one is pre-stressed under `gravity`. Throws rubble::Error naming the stable
  /// substep when the body needs more than maxSubstepsPerFrame. Returns its id.
  virtual std::uint32_t addBody(const BodyDef& def, const Eigen::Vector3d& gravity) = 0;
  /// What came of the pre-stress of a body.
  virtual const PrestressResult& prestressed(std::uint32_t id) const = 0;
  virtual void removeBody(std::uint32_t id) = 0;
  /// Makes a body of the fragment whose lowest element is `root`, between ticks: with the same constants, the
  /// same numbers of elements and springs, and what its contacts remember. Returns its id; none for what is
  /// anchored, sleeps, or is all of the body.
  virtual std::optional<std::uint32_t> split(std::uint32_t id, std::uint32_t root) = 0;

  /// Advances all bodies that are awake by `dt` seconds. `proxies` move along and collect what they are
  /// given.
  virtual void tick(double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies) = 0;
  /// What the last tick did.
  virtual const TickReport& report() const = 0;
  virtual const Books& books() const = 0;
  /// Why the state is not finite any more; empty while all is well.
  virtual const std::string& failure() const = 0;

  /// Largest safe substep as things are now [s].
  virtual double stableStep() const = 0;
  virtual bool anyAwake() const = 0;

  virtual BodyView view(std::uint32_t id) const = 0;
  virtual Eigen::Vector3d position(std::uint32_t id, std::size_t element) const = 0;
  virtual Eigen::Vector3d velocity(std::uint32_t id, std::size_t element) const = 0;
  virtual Eigen::Vector3d spin(std::uint32_t id, std::size_t element) const = 0;
  virtual Eigen::Quaterniond orientation(std::uint32_t id, std::size_t element) const = 0;
  virtual Eigen::AlignedBox3d bounds(
      std::uint32_t id) const = 0;  ///< of what rigid bodies touch of the living elements; empty if none
  virtual double maxSpeed(
      std::uint32_t id) const = 0;  ///< of element centres, and of their surfaces by spin [m/s]
  virtual double radius(std::uint32_t id) const = 0;
  /// Faces of the elements' cells; null where rigid bodies touch spheres. Lives as long as the body.
  virtual const CellFaces* cells(std::uint32_t id) const = 0;
  /// Living elements whose centre lies in the box now, in rising order. Looks at every element.
  virtual void elementsIn(std::uint32_t id, const Eigen::AlignedBox3d& box,
                          std::vector<std::uint32_t>& out) const = 0;

  /// Gives an element of a body that is awake an impulse and one of rotation about its centre, between ticks
  /// [N s], [N m s]. Booked as the host's.
  virtual void push(std::uint32_t id, std::size_t element, const Eigen::Vector3d& linear,
                    const Eigen::Vector3d& angular) = 0;
  /// Motion of all that is alive of a body, or of the fragment whose lowest element is `root`, as one.
  virtual RigidMotion motion(std::uint32_t id, std::uint32_t root = kNoElement) const = 0;
  virtual Placement placement(std::uint32_t id, std::uint32_t root = kNoElement) const = 0;
  /// Adds a rigid motion to that, or moves all of a body with its anchors, between ticks; wakes it. Booked as
  /// the host's.
  virtual void pushAll(std::uint32_t id, std::uint32_t root, const Eigen::Vector3d& velocity,
                       const Eigen::Vector3d& spin) = 0;
  virtual void move(std::uint32_t id, const Eigen::Isometry3d& by) = 0;
  /// Ties the far ends of a body's anchors to something that moves: where the frame is that they are held in
  /// (the asset's axes, the origin in its centre of mass), its velocity [m/s] and spin [rad/s] so far.
  virtual Frame heldFrame(std::uint32_t id) const = 0;
  virtual void setBase(std::uint32_t id, const Twist& velocity) = 0;
  /// Where that frame will be when the next tick ends; without it they stand still. Returns whether they
  /// move; then what they hold wakes.
  virtual bool carry(std::uint32_t id, const Frame& target) = 0;
  /// In place of that: the far ends ride on the proxy with this key through the next tick and press it,
  /// `hold` away in its own axes from its centre of mass. `now` is where they are by that; what they hold is
  /// put there with them, for the host has moved the proxy's body since the last tick, and wakes.
  virtual void ride(std::uint32_t id, std::uint64_t key, const Frame& hold, const Frame& now) = 0;
  /// Presses elements of a body all through its next tick. Booked as the host's; wakes nothing.
  virtual void load(std::uint32_t id, std::span<const HostLoad> loads) = 0;
  /// Gravity of a body's own in place of the world's, or that again [m/s^2]. Returns whether that changes it;
  /// then it wakes.
  virtual bool setGravity(std::uint32_t id, const std::optional<Eigen::Vector3d>& gravity) = 0;
  /// Lets a body bend to what rests on it without a swing: damps its deformation at this rate in
  /// every substep until another spring of it breaks [1/s]; 0: no more.
  virtual void setEasing(std::uint32_t id, double rate) = 0;
  /// Stops a body where it is (its remaining motion is booked), or lets it move again.
  virtual void setAsleep(std::uint32_t id, bool asleep) = 0;
  /// Lends a whole body to the host, which then moves it as one: its elements rest in its frame and touch
  /// nothing. Only one that is awake, has all its elements, in one fragment, and all its anchors; none
  /// otherwise.
  virtual std::optional<ParkedMotion> park(std::uint32_t id) = 0;
  /// What keeps such a body from being lent without a jump; none for others.
  virtual std::optional<Unrest> unrest(std::uint32_t id) const = 0;
  /// Where the asset's frame of a parked body is; anchored ones stay.
  virtual void place(std::uint32_t id, const Eigen::Isometry3d& place) = 0;
  /// Takes it back from where it was placed, with the velocity of its elements' centre of mass [m/s] and the
  /// angular momentum about that [kg m^2/s].
  virtual void unpark(std::uint32_t id, const Eigen::Vector3d& velocity,
                      const Eigen::Vector3d& angularMomentum) = 0;
  /// FNV-1a over the bits of the state of all bodies.
  virtual std::uint64_t hash() const = 0;
};

}  // namespace rubble::edem
