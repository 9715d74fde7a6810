#include "stability/runner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "stability/case_world.h"

namespace rubble::test {
namespace {

constexpr int kMostTicks = 120;
constexpr double kLongest = 1;  // of a run [s]
constexpr double kFloat = std::numeric_limits<float>::epsilon();

class Run {
 public:
  Run(const Case& c, std::function<void(const std::string&)> trace)
      : m_case(c), m_world(c), m_trace(std::move(trace)) {}

  Outcome take() {
    try {
      m_world.build();
    } catch (const Error& error) {
      m_outcome.kind = Outcome::Kind::Refused;
      m_outcome.said = error.what();
      if (m_outcome.said.empty()) violate("refused without a word");
      return m_outcome;
    }
    const Destruction& destruction = *m_world.bullet().destruction;
    m_put = m_world.elementsPut() + rigidKinetic();
    keepPlaces();
    double time = 0;
    int tick = 0;
    while (tick < kMostTicks && time < kLongest && m_outcome.work < kWorkBudget &&
           m_outcome.violations.empty()) {
      const double dt = m_world.stepOf(tick);
      if (tick == kHappeningTick) happen();
      beginTick();
      m_world.step(dt);
      time += dt;
      ++tick;
      m_outcome.work += double(destruction.lastSubsteps()) * destruction.counts().elements;
      if (!destruction.failure().empty()) break;
      judge(dt);
      if (m_trace) m_trace(lineOf(tick, dt));
    }
    m_outcome.ticks = tick;
    close();
    return m_outcome;
  }

 private:
  static constexpr int kHappeningTick = 3;

  std::string lineOf(int tick, double dt) const {
    const Destruction& destruction = *m_world.bullet().destruction;
    const Ledger& l = destruction.ledger();
    const DestructionCounts counts = destruction.counts();
    char text[400];
    std::snprintf(
        text, sizeof text,
        "tick %d dt %.3g substeps %d: kinetic %.4g elastic %.4g gravity %.4g exchanged %.4g debris %.4g "
        "dissipated %.4g fracture %.4g removed %.4g error %.2g made %.3g J | rigid %.4g J | put %.4g held "
        "%.4g J | broken %u crushed %u awake %u",
        tick, dt, destruction.lastSubsteps(), l.kinetic, l.elastic, l.gravity, l.exchanged, l.debris,
        l.dissipated, l.fracture, l.removed, l.energyError, l.made, rigidKinetic(), m_outcome.energyPut,
        m_outcome.energyHeld, counts.springsBroken, counts.crushed, counts.awake);
    return text;
  }

  void violate(const std::string& what) { m_outcome.violations.push_back(what); }

  void happen() {
    const double before = rigidKinetic();
    m_world.happen();
    m_put += std::max(0.0, rigidKinetic() - before);
    keepPlaces();
    // Bullet pushes its own bodies out of each other.
    const auto& bodies = m_world.bullet().destruction->bodies();
    const bool whole = std::any_of(bodies.begin(), bodies.end(), [](const auto* b) { return b->isWhole(); });
    m_pushedByBullet = m_case.happening == Happening::TeleportImpactor && whole;
  }

  // Of dynamic bodies that Bullet moves, whole ones too [J].
  double rigidKinetic() const {
    double sum = 0;
    for (const btRigidBody* body : m_world.moved()) {
      const btVector3 w = body->getAngularVelocity();
      const btMatrix3x3& turn = body->getWorldTransform().getBasis();
      const btVector3 local = w * turn, inverse = body->getInvInertiaDiagLocal();
      for (int a = 0; a < 3; ++a)
        if (inverse[a] > 0) sum += 0.5 * double(local[a] * local[a]) / double(inverse[a]);
      sum += 0.5 / double(body->getInvMass()) * double(body->getLinearVelocity().length2());
    }
    return sum;
  }

  void keepPlaces() {
    m_places.clear();
    m_bulletPlaces.clear();
    for (const DestructibleBody* body : m_world.bullet().destruction->bodies()) {
      std::vector<ElementPose>& poses = m_places[body->id()];
      poses.resize(body->asset()->elementCount());
      body->poses(poses);
    }
    for (const btRigidBody* body : m_world.moved())
      m_bulletPlaces[body] = {body->getWorldTransform().getOrigin(), body->getLinearVelocity(),
                              m_case.gravity, body->getTotalForce()};
  }
  void beginTick() { keepPlaces(); }

  void judge(double dt) {
    bookWeight(dt);
    judgeEnergy();
    judgeSpeeds(dt);
    judgeBullet();
    const double most = std::ceil(60 * dt * maxSubsteps(m_case) * 1.01) + 1;
    if (m_world.bullet().destruction->lastSubsteps() > most)
      violate("took " + std::to_string(m_world.bullet().destruction->lastSubsteps()) +
              " substeps, allowed are " + std::to_string(most));
  }

  // What gravity and the application's forces did on bodies that Bullet moved: by their way or by their mean
  // speed, whichever is more, for places far from the origin are rounded.
  void bookWeight(double dt) {
    for (const btRigidBody* body : m_world.moved()) {
      const auto before = m_bulletPlaces.find(body);
      if (before == m_bulletPlaces.end()) continue;
      const auto& [at, speed, gravity, force] = before->second;
      const double mass = 1 / double(body->getInvMass());
      const btVector3 pull = force + btVector3(0, btScalar(-mass * gravity), 0);
      const double way = double(pull.dot(body->getWorldTransform().getOrigin() - at));
      const double mean = 0.5 * dt * double(pull.dot(body->getLinearVelocity() + speed));
      const double free = dt * double(pull.dot(speed)) + 0.5 * dt * dt / mass * double(pull.length2());
      m_put += std::max({way, mean, force.fuzzyZero() ? way : free});
    }
  }

  void judgeEnergy() {
    const Ledger& l = m_world.bullet().destruction->ledger();
    const std::array numbers = {l.massElements, l.massDebris,   l.massError,   l.linearMomentum.norm(),
                                l.linearError,  l.angularError, l.kinetic,     l.elastic,
                                l.gravity,      l.dissipated,   l.fracture,    l.debris,
                                l.exchanged,    l.removed,      l.energyError, l.made};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!std::isfinite(numbers[i]))
        return violate("number " + std::to_string(i) + " of the ledger is not finite");
    if (l.massError > 1e-6) violate("mass is lost: error " + std::to_string(l.massError));
    // The paper's contacts beside springs press from the start, which the ledger sees in the first step.
    if (m_case.paper && m_outcome.work <= m_world.bullet().destruction->lastSubsteps() *
                                              double(m_world.bullet().destruction->counts().elements))
      m_put += l.elastic + std::max(0.0, l.dissipated);
    const double driven = m_case.impactor == Impactor::Kinematic ? std::max(0.0, l.exchanged) : 0;
    m_mostDriven = std::max(m_mostDriven, driven);
    const double put = m_put + l.gravity + m_mostDriven;
    const double held = l.kinetic + l.elastic + l.debris + rigidKinetic();
    m_mostPut = std::max({m_mostPut, put, m_put});
    m_outcome.energyPut = put;
    m_outcome.energyHeld = held;
    // Places of Bullet's bodies, and of elements as they are told, are floats.
    const double rounded =
        4 * kFloat * m_world.mass() * m_case.gravity * (m_case.distance + 100 * m_case.radius);
    if (!m_pushedByBullet && held > put + kEnergyTolerance * m_mostPut + rounded)
      violate("holds " + std::to_string(held) + " J, put in were " + std::to_string(put) + " J, at most " +
              std::to_string(m_mostPut) + " J; the alarm has " + std::to_string(l.made) + " J");
  }

  // No element is faster than all energy in the lightest of them makes it.
  void judgeSpeeds(double dt) {
    const double lightest = m_world.lightest();
    const double most = std::sqrt(2 * 1.5 * std::max(m_mostPut, 0.0) / lightest) + 2 * m_case.gravity * dt;
    for (const DestructibleBody* body : m_world.bullet().destruction->bodies()) {
      std::vector<ElementPose> poses(body->asset()->elementCount());
      body->poses(poses);
      const auto before = m_places.find(body->id());
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!body->elementsAlive()[i]) continue;
        const Eigen::Vector3f x = poses[i].position;
        if (!x.allFinite() || !poses[i].rotation.allFinite())
          return violate("place of element " + std::to_string(i) + " of body " + std::to_string(body->id()) +
                         " is not finite");
        if (before == m_places.end() || body->isWhole()) continue;
        const double way = (x - before->second[i].position).cast<double>().norm();
        const double slack = 4 * kFloat * double(x.norm()) + 0.01 * m_case.radius;
        if (way > most * dt + slack)
          return violate("element " + std::to_string(i) + " moved at " + std::to_string(way / dt) +
                         " m/s, by its energy at most " + std::to_string(most));
      }
    }
    for (const DebrisPiece& piece : m_world.bullet().destruction->debris())
      if (!piece.position.allFinite() || !piece.velocity.allFinite())
        return violate("a debris piece is not finite");
  }

  void judgeBullet() {
    for (const btRigidBody* body : m_world.healthy()) {
      const btVector3 &x = body->getWorldTransform().getOrigin(), &v = body->getLinearVelocity(),
                      &w = body->getAngularVelocity();
      for (int a = 0; a < 3; ++a)
        if (!std::isfinite(x[a]) || !std::isfinite(v[a]) || !std::isfinite(w[a]))
          return violate("a rigid body is not finite");
    }
  }

  void close() {
    const std::string& failure = m_world.bullet().destruction->failure();
    if (!failure.empty()) {
      m_outcome.kind = Outcome::Kind::Stopped;
      m_outcome.said = failure;
      if (failure.find("body") == std::string::npos) violate("the failure names no body");
    } else if (!m_world.warnings().empty()) {
      m_outcome.kind = Outcome::Kind::Degraded;
      m_outcome.said = m_world.warnings().front();
    }
    // A whole body that Bullet spoiled is what the run stopped for.
    if (m_outcome.kind != Outcome::Kind::Stopped) judgeBullet();
  }

  struct Before {
    btVector3 at, speed;
    double gravity;
    btVector3 force;
  };

  Case m_case;
  CaseWorld m_world;
  std::function<void(const std::string&)> m_trace;
  Outcome m_outcome;
  double m_put = 0;      // without gravity's work on elements, which the ledger has [J]
  double m_mostPut = 0;  // [J]
  double m_mostDriven = 0;
  bool m_pushedByBullet = false;
  std::map<std::uint32_t, std::vector<ElementPose>> m_places;
  std::map<const btRigidBody*, Before> m_bulletPlaces;
};

}  // namespace

const char* nameOf(Outcome::Kind kind) {
  static constexpr std::array<const char*, 4> kNames = {"stable", "degraded", "refused", "stopped"};
  return kNames.at(std::size_t(kind));
}

Outcome run(const Case& c, const std::function<void(const std::string&)>& trace) {
  return Run(c, trace).take();
}

}  // namespace rubble::test
