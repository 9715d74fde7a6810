#include "edem/solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/hash.h"
#include "base/number_text.h"
#include "base/stopwatch.h"
#include "edem/damping.h"
#include "edem/fragment_motion.h"
#include "edem/frames.h"
#include "edem/pair_lists.h"
#include "edem/prestress.h"
#include "edem/rigid_contacts.h"
#include "edem/step_length.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::edem {
namespace {

// Skin of the candidate lists in radii: half of it is what an element may move before a new listing.
constexpr double kSkinRadii = 0.5;
// An element may not pass more than this share of its radius in a substep, or thin things are missed.
constexpr double kTravelShare = 0.25;

template <class Real>
class SolverOf final : public Solver {
 public:
  explicit SolverOf(const SolverDef& def) : m_def(def) {}

  std::uint32_t addBody(const BodyDef& def, const Eigen::Vector3d& gravity) override {
    auto body = std::make_unique<Body<Real>>(makeBody<Real>(def, m_nextId));
    const double step = m_def.substepSafety * bodyBound(*body).stableStep();
    const double substeps = std::ceil(1.0 / 60 / step);
    if (substeps > m_def.maxSubstepsPerFrame) {
      char text[320];
      std::snprintf(text, sizeof text,
                    "material %s: stable substep is %.3g s, which is %.0f substeps in 1/60 s; "
                    "max_substeps_per_frame is %d: raise "
                    "it, or lower the material's youngsModulus, or use larger elements",
                    def.material.name.c_str(), step, substeps, m_def.maxSubstepsPerFrame);
      throw Error(text);
    }
    PrestressResult prestressed;
    if (def.anchored && gravity.squaredNorm() > 0) prestressed = prestress(*body, gravity, &m_restCache);
    beginSubstep(*body);
    bookNew(*body);
    m_bodies.push_back(std::move(body));
    m_prestressed.push_back(std::move(prestressed));
    m_listsStale = true;
    return m_nextId++;
  }

  const PrestressResult& prestressed(std::uint32_t id) const override { return m_prestressed[placeOf(id)]; }

  void removeBody(std::uint32_t id) override {
    const std::size_t place = placeOf(id);
    bookLeaving(*m_bodies[place], std::uint32_t(place));
    m_bodies.erase(m_bodies.begin() + std::ptrdiff_t(place));
    m_prestressed.erase(m_prestressed.begin() + std::ptrdiff_t(place));
    m_lists.removeBody(std::uint32_t(place));
    m_listsStale = true;
  }

  void tick(double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies) override;

  const TickReport& report() const override { return m_report; }
  const Books& books() const override { return m_books; }
  const std::string& failure() const override { return m_failure; }

  double stableStep() const override {
    double step = std::numeric_limits<double>::infinity();
    for (const auto& body : m_bodies)
      step = std::min(step, m_def.substepSafety * bodyBound(*body).stableStep());
    return step;
  }
  bool anyAwake() const override {
    return std::any_of(m_bodies.begin(), m_bodies.end(), [](const auto& b) { return !b->asleep; });
  }

  BodyView view(std::uint32_t id) const override {
    const Body<Real>& b = of(id);
    return {b.alive,         b.intact,       b.fragment,    b.mass,  b.inertia,
            b.fragmentCount, b.crushedCount, b.brokenCount, b.asleep};
  }
  Eigen::Vector3d position(std::uint32_t id, std::size_t i) const override { return of(id).worldPosition(i); }
  Eigen::Vector3d velocity(std::uint32_t id, std::size_t i) const override {
    return of(id).velocity[i].template cast<double>();
  }
  Eigen::Vector3d spin(std::uint32_t id, std::size_t i) const override {
    return of(id).spin[i].template cast<double>();
  }
  Eigen::Quaterniond orientation(std::uint32_t id, std::size_t i) const override {
    return of(id).orientation(i);
  }
  Eigen::AlignedBox3d bounds(std::uint32_t id) const override {
    const Body<Real>& b = of(id);
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < b.elementCount(); ++i)
      if (b.alive[i]) box.extend(b.worldPosition(i));
    if (box.isEmpty()) return box;
    box.min().array() -= b.reach();
    box.max().array() += b.reach();
    return box;
  }
  double maxSpeed(std::uint32_t id) const override { return speedOf(of(id)); }
  double radius(std::uint32_t id) const override { return double(of(id).radius); }
  void elementsIn(std::uint32_t id, const Eigen::AlignedBox3d& box,
                  std::vector<std::uint32_t>& out) const override;

  void push(std::uint32_t id, std::size_t i, const Eigen::Vector3d& linear,
            const Eigen::Vector3d& angular) override {
    Body<Real>& body = *m_bodies[placeOf(id)];
    assert(i < body.elementCount() && linear.allFinite() && angular.allFinite());
    const Vec3<Real> v0 = body.velocity[i], w0 = body.spin[i];
    body.velocity[i] += body.inverseMass[i] * linear.cast<Real>();
    body.spin[i] += body.inverseInertia[i] * angular.cast<Real>();
    const Eigen::Vector3d gained = body.mass[i] * (body.velocity[i] - v0).template cast<double>();
    const Eigen::Vector3d turned = body.inertia[i] * (body.spin[i] - w0).template cast<double>();
    const Eigen::Vector3d arm = body.worldPosition(i) - m_books.centre;
    const double work = 0.5 * (gained.dot((v0 + body.velocity[i]).template cast<double>()) +
                               turned.dot((w0 + body.spin[i]).template cast<double>()));
    m_books.bullet.push(1, gained, arm, turned);
    m_books.bullet.work.add(work, 0);
    m_books.linear += gained;
    m_books.angular += arm.cross(gained) + turned;
    m_books.kinetic += work;
  }

  void setSettling(std::uint32_t id, double rate) override {
    assert(rate >= 0);
    m_bodies[placeOf(id)]->settleDamping = rate;
  }

  void setAsleep(std::uint32_t id, bool asleep) override {
    Body<Real>& body = *m_bodies[placeOf(id)];
    if (body.asleep == asleep) return;
    body.asleep = asleep;
    m_listsStale = true;
    if (!asleep) return;
    body.sleepingElastic = elasticOf(body);
    bookSlept(body, m_books);
  }

  std::uint64_t hash() const override {
    base::Fnv1a hash;
    for (const auto& b : m_bodies) {
      hash.add(std::as_bytes(std::span<const Vec3<Real>>(b->displacement)));
      hash.add(std::as_bytes(std::span<const Vec3<Real>>(b->velocity)));
      hash.add(std::as_bytes(std::span<const Vec3<Real>>(b->spin)));
      hash.add(std::as_bytes(std::span<const Quat<Real>>(b->rotation)));
      hash.add(std::as_bytes(std::span<const std::uint8_t>(b->alive)));
      hash.add(std::as_bytes(std::span<const std::uint8_t>(b->intact)));
      hash.add(std::as_bytes(std::span<const std::uint32_t>(b->frameOf)));
      for (const Frame& f : b->frames) {
        hash.add(std::as_bytes(std::span<const double>(f.origin.data(), 3)));
        hash.add(std::as_bytes(std::span<const double>(f.turn.coeffs().data(), 4)));
      }
    }
    return hash.value();
  }

 private:
  std::size_t placeOf(std::uint32_t id) const {
    for (std::size_t b = 0; b < m_bodies.size(); ++b)
      if (m_bodies[b]->id == id) return b;
    throw Error("no destructible body has the id " + std::to_string(id));
  }
  const Body<Real>& of(std::uint32_t id) const { return *m_bodies[placeOf(id)]; }

  RateBound bodyBound(const Body<Real>& body) const {
    std::vector<ElementRates> rates(body.elementCount());
    springRates(body, std::span(rates));
    RateBound bound = springBound(body, std::span<const ElementRates>(rates));
    // Any element may press another, or a rigid body, beside its springs.
    const ContactLaw<double> law = contactLaw(body.contact, body.contact);
    for (std::size_t i = 0; i < body.elementCount(); ++i) {
      ElementRates contact = rates[i];
      const ElementRates one = contactRates(law, 1 / body.mass[i], 1 / body.inertia[i], double(body.radius));
      contact.stiffness += one.stiffness;
      contact.damping += one.damping;
      bound.add(contact, {});
    }
    return bound;
  }
  static double speedOf(const Body<Real>& b) {
    double fastest = 0;
    for (std::size_t i = 0; i < b.elementCount(); ++i)
      if (b.alive[i])
        fastest =
            std::max(fastest, double(b.velocity[i].norm()) + double(b.radius) * double(b.spin[i].norm()));
    return fastest;
  }

  // Elastic energy of a body's springs as they stand [J].
  double elasticOf(const Body<Real>& body) {
    Books probe;
    Body<Real> copy = body;
    beginSubstep(copy);
    return accumulateSprings(copy, 0, false, probe);
  }

  void bookNew(const Body<Real>& body);
  void bookLeaving(const Body<Real>& body, std::uint32_t place);
  void list();
  bool refreshLists();
  bool contactsBegan() const;
  void refreshFragments();
  double longestStep(double dt);
  void substep(double kick, double step, const Eigen::Vector3d& gravity);
  void closeTick(double dt);

  SolverDef m_def;
  std::uint32_t m_nextId = 0;
  std::vector<std::unique_ptr<Body<Real>>> m_bodies;
  std::vector<PrestressResult> m_prestressed;  // beside m_bodies
  StaticRestCache m_restCache;
  PairLists<Real> m_lists;
  RigidContacts<Real> m_rigid;
  bool m_listsStale = true;
  double m_lastStep = 0;  // of the positions; 0 before the first
  StepLength<Real> m_stepLength;
  TickReport m_report;
  Books m_books;
  std::string m_failure;
};

// A tick reads top to bottom. The host applies proxies' impulses and handles the crushed
// afterwards.
template <class Real>
void SolverOf<Real>::tick(double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies) {
  m_report.broken.clear();
  m_report.crushed.clear();
  m_report.substeps = 0;
  m_report.listing = 0;
  m_report.warning.clear();
  if (!std::isfinite(dt)) m_failure = "the time step is not finite";
  if (!m_failure.empty() || !(dt > 0)) return;
  m_rigid.beginTick(proxies);
  m_stepLength.beginTick(m_bodies);
  for (auto& body : m_bodies)
    if (!body->asleep || body->motions.empty()) beginMotions(*body);
  m_listsStale = true;
  double left = dt, step = dt;
  int substeps = 0;
  while (left > 0 && m_failure.empty()) {
    for (auto& body : m_bodies)
      if (!body->asleep) beginSubstep(*body);
    const bool listed = refreshLists();
    if (listed) refreshFragments();
    if (listed || contactsBegan()) {
      // What is near has changed: the rest of the tick in equal steps that are short enough for it.
      const double longest = substeps == 0 ? longestStep(dt) : std::min(step, longestStep(dt));
      if (!m_failure.empty()) break;
      step = left / std::ceil(left / longest * (1 - 1e-9));
    }
    // Between steps of two lengths the half steps are their mean apart.
    const double kick = m_lastStep > 0 ? 0.5 * (m_lastStep + step) : step;
    substep(kick, step, gravity);
    m_lastStep = step;
    ++substeps;
    left = left - step > 0.5 * step ? left - step : 0;
  }
  m_report.substeps = substeps;
  m_report.substep = step;
  closeTick(dt);
}

template <class Real>
void SolverOf<Real>::substep(double kick, double step, const Eigen::Vector3d& gravity) {
  m_books.closeStep();
  m_books.elastic = 0;
  for (auto& body : m_bodies)
    m_books.elastic +=
        body->asleep ? body->sleepingElastic : accumulateSprings(*body, kick, m_def.breaking, m_books);
  for (PairList<Real>& l : m_lists.lists()) {
    Body<Real>&a = *m_bodies[l.first], &b = *m_bodies[l.second];
    if (!a.asleep || !b.asleep) accumulateContacts(l, a, b, {m_lastStep, step}, m_books);
    m_books.elastic += l.elastic;
  }
  m_rigid.accumulate(m_bodies, {m_lastStep, step}, kick, m_books);
  m_books.elastic += m_rigid.elastic();

  const std::size_t brokenBegin = m_report.broken.size();
  bool anyCrushed = false;
  for (auto& body : m_bodies) {
    if (body->asleep || !m_def.crushing || !m_def.breaking) continue;
    markCrushed(*body);
    anyCrushed = anyCrushed || !body->crushing.empty();
  }
  if (anyCrushed) {
    for (PairList<Real>& l : m_lists.lists())
      releaseContacts(l, *m_bodies[l.first], *m_bodies[l.second], step, kick, m_books);
    m_rigid.release(m_bodies, kick, m_books);
  }
  for (std::uint32_t b = 0; b < m_bodies.size(); ++b)
    if (!m_bodies[b]->asleep) applyBreaks(*m_bodies[b], b, kick, m_lists, m_books, m_report);
  if (m_report.broken.size() > brokenBegin) m_rigid.expose(m_bodies, step, kick, m_books);

  m_books.mass = m_books.kinetic = 0;
  m_books.linear = m_books.angular = Eigen::Vector3d::Zero();
  for (std::uint32_t b = 0; b < m_bodies.size(); ++b) {
    Body<Real>& body = *m_bodies[b];
    if (body.asleep) {
      for (std::size_t i = 0; i < body.elementCount(); ++i) m_books.mass += body.alive[i] ? body.mass[i] : 0;
      continue;
    }
    const Real moved2 =
        integrate(body, kick, step, gravity, std::span<const Vec3<double>>(m_lists.grid(b).listed), m_books);
    if (!std::isfinite(moved2))
      m_failure = "body " + std::to_string(body.id) + ": the state of its elements is not finite";
    moveMotions(body, kick, step, gravity);
    m_listsStale = m_listsStale || !(moved2 <= Real(0.25 * m_lists.skin() * m_lists.skin()));
  }
  m_rigid.integrate(m_bodies, kick, step, m_books);
  for (auto& body : m_bodies)
    if (!body->crushing.empty()) removeCrushed(*body, brokenBegin, m_books, m_report);
}

template <class Real>
void SolverOf<Real>::list() {
  const base::ScopeTimer timer(m_report.listing);
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& body : m_bodies) radius = std::min(radius, double(body->radius));
  m_lists.build(m_bodies, m_bodies.empty() ? 0 : kSkinRadii * radius);
  m_rigid.build(m_bodies, m_lists);
  m_listsStale = false;
}

// Lists anew what is out of date; true if anything was.
template <class Real>
bool SolverOf<Real>::refreshLists() {
  if (m_listsStale) {
    list();
  } else if (m_rigid.expired(m_lists.skin())) {
    m_rigid.build(m_bodies, m_lists);
  } else {
    return false;
  }
  return true;
}

// What has broken free parts from what it hits as itself, not when the tick is over: restitution would depend
// on the tick.
template <class Real>
void SolverOf<Real>::refreshFragments() {
  for (auto& body : m_bodies) {
    if (body->asleep || body->labelledBroken == body->brokenCount) continue;
    labelFragments(*body);
    beginMotions(*body);
  }
}

// More contacts began at an element than the step was chosen for.
template <class Real>
bool SolverOf<Real>::contactsBegan() const {
  return std::any_of(m_bodies.begin(), m_bodies.end(), [](const auto& body) {
    const auto& begun = body->touchesBegun;
    return !body->asleep && std::any_of(begun.begin(), begun.end(), [](std::uint16_t n) { return n > 1; });
  });
}

// Longest safe step of a tick of `dt` as things are now [s]; a tick that would need too many fails.
template <class Real>
double SolverOf<Real>::longestStep(double dt) {
  m_stepLength.bound(m_bodies, m_lists, m_rigid);
  const double stable = std::min(m_def.substepSafety * m_stepLength.stable(), m_stepLength.resolving());
  double speed = m_rigid.maxSpeed(), radius = std::numeric_limits<double>::infinity();
  for (const auto& body : m_bodies) {
    if (body->asleep) continue;
    speed = std::max(speed, speedOf(*body));
    radius = std::min(radius, double(body->radius));
  }
  const bool travels = speed > 0 && std::isfinite(radius);
  const double travel = travels ? kTravelShare * radius / speed : std::numeric_limits<double>::infinity();
  const double shortest = 1.0 / 60 / m_def.maxSubstepsPerFrame * (1 - 1e-9);
  char text[200];
  if (stable < shortest) {
    std::snprintf(text, sizeof text,
                  "body %u: its contacts need a substep of %.3g s; max_substeps_per_frame %d allows %.3g s",
                  m_bodies[m_stepLength.stiffest()]->id, stable, m_def.maxSubstepsPerFrame, shortest);
    m_failure = text;
  } else if (travel < shortest) {
    std::snprintf(text, sizeof text,
                  "something moves at %.3g m/s, more than max_substeps_per_frame %d can follow: contacts may "
                  "be missed",
                  speed, m_def.maxSubstepsPerFrame);
    m_report.warning = text;
    return std::min({dt, stable, shortest});
  }
  return std::min({dt, stable, travel});
}

template <class Real>
void SolverOf<Real>::closeTick(double dt) {
  for (auto& body : m_bodies) {
    if (body->asleep) continue;
    const bool broke = std::any_of(m_report.broken.begin(), m_report.broken.end(),
                                   [&](const BrokenSpring& s) { return s.body == body->id; });
    if (broke) {
      labelFragments(*body);
      splitFrames(*body);
    }
    const double damping = std::max(body->massDamping, body->settleDamping);
    if (damping > 0) dampDeformation(*body, damping, dt, m_books);
    fitFrames(*body);
  }
}

template <class Real>
void SolverOf<Real>::bookNew(const Body<Real>& body) {
  Books probe = m_books;
  const bool first = m_bodies.empty() && m_books.initialMass == 0;
  if (first) m_books.centre = body.origin;
  double mass = 0, kinetic = 0, size = 0;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d v = body.velocity[i].template cast<double>(),
                          w = body.spin[i].template cast<double>();
    const double m = body.mass[i];
    mass += m;
    kinetic += 0.5 * (m * v.squaredNorm() + body.inertia[i] * w.squaredNorm());
    size += m * v.norm();
    linear += m * v;
    angular += (body.worldPosition(i) - m_books.centre).cross(m * v) + body.inertia[i] * w;
  }
  Body<Real> copy = body;
  const double elastic = accumulateSprings(copy, 0, false, probe);
  m_books.initialMass += mass;
  m_books.initialMomentumSize += size;
  m_books.initialLinear += linear;
  m_books.initialAngular += angular;
  m_books.initialEnergy += kinetic + elastic;
  m_books.diagonal = std::max(m_books.diagonal, body.asset->diagonal());
  m_books.mass += mass;
  m_books.kinetic += kinetic;
  m_books.elastic += elastic;
  m_books.linear += linear;
  m_books.angular += angular;
}

template <class Real>
void SolverOf<Real>::bookLeaving(const Body<Real>& body, std::uint32_t place) {
  Books probe = m_books;
  probe.mass = probe.kinetic = 0;
  probe.linear = probe.angular = Eigen::Vector3d::Zero();
  Body<Real> copy = body;
  beginSubstep(copy);
  double elastic = accumulateSprings(copy, 0, false, probe);
  for (const PairList<Real>& l : m_lists.lists())
    if (l.first == place || l.second == place) elastic += l.elastic;
  integrate(copy, 0, 0, Eigen::Vector3d::Zero(), std::span<const Vec3<double>>(copy.position), probe);
  m_books.leftMass += probe.mass;
  m_books.leftKinetic += probe.kinetic;
  m_books.leftElastic += elastic;
  m_books.leftLinear += probe.linear;
  m_books.leftAngular += probe.angular;
  m_books.mass -= probe.mass;
  m_books.kinetic -= probe.kinetic;
  m_books.elastic -= elastic;
  m_books.linear -= probe.linear;
  m_books.angular -= probe.angular;
}

template <class Real>
void SolverOf<Real>::elementsIn(std::uint32_t id, const Eigen::AlignedBox3d& box,
                                std::vector<std::uint32_t>& out) const {
  const Body<Real>& body = of(id);
  out.clear();
  for (std::uint32_t i = 0; i < body.elementCount(); ++i)
    if (body.alive[i] && box.contains(body.worldPosition(i))) out.push_back(i);
}

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
