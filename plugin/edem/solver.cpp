#include "edem/solver.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "base/hash.h"
#include "base/number_text.h"
#include "edem/body_books.h"
#include "edem/body_queries.h"
#include "edem/damping.h"
#include "edem/frames.h"
#include "edem/host_moves.h"
#include "edem/parking.h"
#include "edem/prestress.h"
#include "edem/sleep.h"
#include "edem/split.h"
#include "edem/step_length.h"
#include "edem/tick.h"
#include "edem/world.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::edem {
namespace {

template <class Real>
class SolverOf final : public Solver {
 public:
  explicit SolverOf(const SolverDef& def) { m_world.def = def; }

  std::uint32_t addBody(const BodyDef& def, const Eigen::Vector3d& gravity) override {
    auto body = std::make_unique<Body<Real>>(makeBody<Real>(def, m_nextId));
    requireStep(*body, def.material, stableStepOf(*body), m_world.def);
    PrestressResult prestressed;
    if (def.anchored && gravity.squaredNorm() > 0) prestressed = prestress(*body, gravity, &m_restCache);
    beginSubstep(body->state, body->work);
    bookNew(*body, m_world.books);
    m_bodies.push_back({body.get(), std::move(prestressed)});
    m_world.bodies.push_back(std::move(body));
    m_world.listsStale = true;
    return m_nextId++;
  }

  const PrestressResult& prestressed(std::uint32_t id) const override {
    require(id);
    return m_bodies[id].prestressed;
  }

  void removeBody(std::uint32_t id) override {
    double contacts = 0;
    if (of(id).state.parked) {
      bookLeaving(of(id), contacts, m_world.books);
      takeOut(m_world.parked, id);
      sumParked();
    } else {
      const std::uint32_t place = placeOf(id);
      wakeNeighbours(m_world, place);
      for (const PairList<Real>& l : m_world.lists.lists())
        if (l.first == place || l.second == place) contacts += l.elastic;
      bookLeaving(of(id), contacts, m_world.books);
      leaveTicks(id);
    }
    m_bodies[id] = {};
  }

  std::optional<std::uint32_t> split(std::uint32_t id, std::uint32_t root) override {
    Body<Real>& body = of(id);
    if (!maySplit(body, root)) return std::nullopt;
    const std::uint32_t place = placeOf(id), newPlace = std::uint32_t(m_world.bodies.size());
    const std::vector<std::uint8_t> members = membersOf(body, root);
    m_world.bodies.push_back(std::make_unique<Body<Real>>(splitOff(body, members, m_nextId)));
    m_bodies.push_back({m_world.bodies.back().get(), {}});
    m_world.lists.split(place, members, *m_world.bodies[newPlace], newPlace);
    m_world.lists.listAwake(m_world.bodies);
    m_world.rigid.split(id, members, m_nextId);
    m_world.resting.rename(fragmentName(id, root), fragmentName(m_nextId, root));
    m_world.listsStale = true;
    return m_nextId++;
  }

  void tick(double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies) override {
    edem::tick(m_world, dt, gravity, proxies);
  }

  const TickReport& report() const override { return m_world.report; }
  const Books& books() const override { return m_world.books; }
  const std::string& failure() const override { return m_world.failure; }

  double stableStep() const override {
    double step = std::numeric_limits<double>::infinity();
    for (const Known& known : m_bodies)
      if (known.body) step = std::min(step, stableStepOf(*known.body));
    return step;
  }
  bool anyAwake() const override {
    return std::any_of(m_world.bodies.begin(), m_world.bodies.end(),
                       [](const auto& b) { return !b->state.asleep; });
  }

  BodyView view(std::uint32_t id) const override {
    const Body<Real>& b = of(id);
    return {b.state.alive,        b.state.intact,         b.state.fragment,      b.constants->mass,
            b.constants->inertia, b.state.sleeping,       b.state.fragmentCount, b.state.crushedCount,
            b.state.brokenCount,  b.state.asleep,         b.state.sleepingCount, b.state.anchorsIntact,
            b.state.sleepChanges, b.state.absentElements, b.state.absentSprings};
  }
  Eigen::Vector3d position(std::uint32_t id, std::size_t i) const override { return of(id).worldPosition(i); }
  Eigen::Vector3d velocity(std::uint32_t id, std::size_t i) const override {
    return of(id).state.velocity[i].template cast<double>();
  }
  Eigen::Vector3d spin(std::uint32_t id, std::size_t i) const override {
    return of(id).state.spin[i].template cast<double>();
  }
  Eigen::Quaterniond orientation(std::uint32_t id, std::size_t i) const override {
    return of(id).orientation(i);
  }
  Eigen::AlignedBox3d bounds(std::uint32_t id) const override { return boundsOf(of(id)); }
  double maxSpeed(std::uint32_t id) const override { return speedOf(of(id)); }
  double radius(std::uint32_t id) const override { return double(of(id).constants->radius); }
  const CellFaces* cells(std::uint32_t id) const override { return of(id).constants->cells.get(); }
  void elementsIn(std::uint32_t id, const Eigen::AlignedBox3d& box,
                  std::vector<std::uint32_t>& out) const override {
    edem::elementsIn(of(id), box, out);
  }

  void push(std::uint32_t id, std::size_t i, const Eigen::Vector3d& linear,
            const Eigen::Vector3d& angular) override {
    wakeElement(m_world, placeOf(id), std::uint32_t(i));
    pushElement(of(id), i, linear, angular, m_world.books);
  }

  RigidMotion motion(std::uint32_t id, std::uint32_t root) const override {
    return wholeMotion(of(id), root);
  }
  Placement placement(std::uint32_t id, std::uint32_t root) const override {
    return placementOf(of(id), root);
  }
  void pushAll(std::uint32_t id, std::uint32_t root, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& spin) override {
    Body<Real>& body = of(id);
    forgetSleep(body);
    m_world.listsStale = true;
    pushWhole(body, root, velocity, spin, m_world.books);
  }
  void move(std::uint32_t id, const Eigen::Isometry3d& by) override {
    Body<Real>& body = of(id);
    forgetSleep(body);
    endContactsOf(id);
    moveWhole(body, by, m_world.books);
  }

  Frame heldFrame(std::uint32_t id) const override { return of(id).state.frames[0]; }
  void setBase(std::uint32_t id, const Twist& velocity) override {
    Body<Real>& body = of(id);
    assert(!body.state.parked);
    body.state.base = {};
    body.state.base.given = true;
    body.state.base.at = body.state.frames[0];
    body.state.base.velocity = body.state.base.mean = body.state.base.end = velocity;
    writeFarEnds(body);
  }
  bool carry(std::uint32_t id, const Frame& target) override {
    Body<Real>& body = of(id);
    AnchorBase& base = body.state.base;
    assert(base.given);
    base.ride = {};
    const Frame& now = body.state.frames[0];
    if (target.origin == now.origin && target.turn.coeffs() == now.turn.coeffs()) return !base.end.isZero();
    base.target = target;
    wakeHeld(id);
    return true;
  }
  void ride(std::uint32_t id, std::uint64_t key, const Frame& hold, const Frame& now) override {
    Body<Real>& body = of(id);
    assert(body.state.base.given && key != 0);
    wakeHeld(id);
    body.state.base.ride = {};
    body.state.base.ride.key = key;
    body.state.base.ride.hold = hold;
    const Frame& was = body.state.frames[0];
    if (now.origin == was.origin && now.turn.coeffs() == was.turn.coeffs()) return;
    // Nothing that touched it does after a leap.
    if ((now.origin - was.origin).norm() > double(body.constants->radius)) endContactsOf(id);
    moveHeld(body, now, m_world.books);
    m_world.listsStale = true;
  }

  void load(std::uint32_t id, std::span<const HostLoad> loads) override {
    Body<Real>& body = of(id);
    body.state.hostLoads.insert(body.state.hostLoads.end(), loads.begin(), loads.end());
  }

  bool setGravity(std::uint32_t id, const std::optional<Eigen::Vector3d>& gravity) override {
    Body<Real>& body = of(id);
    if (body.state.gravity == gravity) return false;
    body.state.gravity = gravity;
    if (body.state.parked) return true;
    setAsleep(id, false);
    forgetSleep(body);
    m_world.listsStale = true;
    return true;
  }

  void setEasing(std::uint32_t id, double rate) override {
    assert(rate >= 0);
    Body<Real>& body = of(id);
    body.state.easeDamping = rate;
    body.state.easeBroken = body.state.brokenCount;
  }

  void setAsleep(std::uint32_t id, bool asleep) override {
    Body<Real>& body = of(id);
    if (body.state.asleep == asleep) return;
    body.state.asleep = asleep;
    m_world.listsStale = true;
    // What its fragments lay on may have gone while nobody looked.
    if (!asleep) return forgetSleep(body);
    body.state.sleepingElastic = elasticOf(body);
    body.state.sleepingMass = massOf(body);
    bookSlept(body, m_world.books);
  }

  std::optional<ParkedMotion> park(std::uint32_t id) override {
    Body<Real>& body = of(id);
    if (!mayPark(body)) return std::nullopt;
    forgetSleep(body);
    endContactsOf(id);
    const ParkedMotion motion = edem::park(body, m_world.books);
    putIn(m_world.parked, leaveTicks(id));
    sumParked();
    return motion;
  }
  std::optional<Unrest> unrest(std::uint32_t id) const override {
    if (!mayPark(of(id))) return std::nullopt;
    Unrest unrest = unrestOf(of(id));
    unrest.overlap = m_world.rigid.overlapOf(id);
    return unrest;
  }
  void place(std::uint32_t id, const Eigen::Isometry3d& place) override { placeParked(of(id), place); }
  void unpark(std::uint32_t id, const Eigen::Vector3d& velocity,
              const Eigen::Vector3d& angularMomentum) override {
    edem::unpark(of(id), velocity, angularMomentum, m_world.books);
    m_world.lists.insertBody(putIn(m_world.bodies, takeOut(m_world.parked, id)), id);
    m_world.listsStale = true;
    sumParked();
  }

  std::uint64_t hash() const override {
    base::Fnv1a hash;
    for (const Known& known : m_bodies)
      if (known.body) addTo(hash, *known.body);
    return hash.value();
  }

 private:
  using Bodies = std::vector<std::unique_ptr<Body<Real>>>;
  struct Known {
    Body<Real>* body = nullptr;  // null: removed
    PrestressResult prestressed;
  };

  // What the anchors hold.
  void wakeHeld(std::uint32_t id) {
    const Body<Real>& body = of(id);
    const std::uint32_t place = placeOf(id);
    if (body.state.asleep) setAsleep(id, false);
    for (std::uint32_t i = 0; i < body.elementCount(); ++i)
      if (body.state.alive[i] && body.state.frameOf[i] == 0) wakeElement(m_world, place, i);
  }

  void require(std::uint32_t id) const {
    if (id >= m_bodies.size() || !m_bodies[id].body)
      throw Error("no destructible body has the id " + std::to_string(id));
  }
  const Body<Real>& of(std::uint32_t id) const {
    require(id);
    return *m_bodies[id].body;
  }
  Body<Real>& of(std::uint32_t id) {
    require(id);
    return *m_bodies[id].body;
  }
  // Where the body is among those, or would be.
  static auto at(Bodies& bodies, std::uint32_t id) {
    return std::ranges::lower_bound(bodies, id, {}, [](const auto& body) { return body->id; });
  }
  std::uint32_t placeOf(std::uint32_t id) {
    assert(!of(id).state.parked);
    return std::uint32_t(at(m_world.bodies, id) - m_world.bodies.begin());
  }
  static std::unique_ptr<Body<Real>> takeOut(Bodies& bodies, std::uint32_t id) {
    const auto place = at(bodies, id);
    std::unique_ptr<Body<Real>> body = std::move(*place);
    bodies.erase(place);
    return body;
  }
  static std::uint32_t putIn(Bodies& bodies, std::unique_ptr<Body<Real>> body) {
    const auto place = bodies.insert(at(bodies, body->id), std::move(body));
    return std::uint32_t(place - bodies.begin());
  }
  std::unique_ptr<Body<Real>> leaveTicks(std::uint32_t id) {
    m_world.lists.removeBody(std::uint32_t(at(m_world.bodies, id) - m_world.bodies.begin()));
    m_world.listsStale = true;
    return takeOut(m_world.bodies, id);
  }
  void sumParked() {
    m_world.parkedMass = m_world.parkedElastic = 0;
    for (const auto& body : m_world.parked) {
      m_world.parkedMass += body->state.sleepingMass;
      m_world.parkedElastic += body->state.sleepingElastic;
    }
  }
  // The host takes a body from where it touched.
  void endContactsOf(std::uint32_t id) {
    const double contacts = m_world.lists.endContactsOf(id) + m_world.rigid.endContactsOf(id);
    m_world.books.elastic -= contacts;
    m_world.books.massDamped += contacts;
    m_world.listsStale = true;
  }
  double stableStepOf(const Body<Real>& body) const {
    return m_world.def.substepSafety * bodyBound(body).stableStep();
  }

  World<Real> m_world;
  std::uint32_t m_nextId = 0;
  std::vector<Known> m_bodies;  // by id
  StaticRestCache m_restCache;
};

}  // namespace

std::unique_ptr<Solver> Solver::make(Precision precision, const SolverDef& def) {
  const auto require = [](const Limits& limits, const char* key, double value) {
    if (!limits.hold(value))
      throw Error(std::string(key) + ": is " + base::numberText(value) + ", must be " + limits.text());
  };
  require(limits::kSubstepSafety, "substepSafety", def.substepSafety);
  require(limits::kMaxSubstepsPerFrame, "maxSubstepsPerFrame", def.maxSubstepsPerFrame);
  if (precision == Precision::Double) return std::make_unique<SolverOf<double>>(def);
  return std::make_unique<SolverOf<float>>(def);
}

}  // namespace rubble::edem
