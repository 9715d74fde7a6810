#include "demo/stability/runner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "demo/stability/case_world.h"
#include "demo/stability/rigid_books.h"

namespace rubble::stability {
namespace {

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
      keepPlaces();
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
  double rigidKinetic() const { return kineticEnergy(m_world.moved()); }

  void keepPlaces() {
    m_places.clear();
    for (const DestructibleBody* body : m_world.bullet().destruction->bodies()) {
      std::vector<ElementPose>& poses = m_places[body->id()];
      poses.resize(body->asset()->elementCount());
      body->poses(poses);
    }
    m_weights.begin(m_world.moved());
  }

  void judge(double dt) {
    m_put += m_weights.work(m_world.moved(), m_case.gravity, dt);
    if (const btRigidBody* kinematic = m_world.kinematic())
      m_wholesDriven += contactWork(*kinematic, m_world.bullet().dispatcher);
    judgeEnergy();
    judgeSpeeds(dt);
    judgeBullet();
    const double most = std::ceil(60 * dt * maxSubsteps(m_case) * 1.01) + 1;
    if (m_world.bullet().destruction->lastSubsteps() > most)
      violate("took " + std::to_string(m_world.bullet().destruction->lastSubsteps()) +
              " substeps, allowed are " + std::to_string(most));
  }

  void judgeEnergy() {
    const Ledger& l = m_world.bullet().destruction->ledger();
    const std::array numbers = {l.massElements,  l.massDebris,   l.massError,   l.linearMomentum.norm(),
                                l.linearError,   l.angularError, l.kinetic,     l.elastic,
                                l.gravity,       l.dissipated,   l.fracture,    l.debris,
                                l.exchanged,     l.removed,      l.energyError, l.made,
                                l.exchangedNext, l.placed};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!std::isfinite(numbers[i]))
        return violate("number " + std::to_string(i) + " of the ledger is not finite");
    if (l.massError > 1e-6) violate("mass is lost: error " + std::to_string(l.massError));
    // The paper's contacts beside springs press from the start, with energy that no book has: what the ledger
    // does not close by in the first tick.
    if (m_case.paper && m_outcome.work <= m_world.bullet().destruction->lastSubsteps() *
                                              double(m_world.bullet().destruction->counts().elements))
      m_put += std::max(0.0, l.kinetic + l.elastic + l.debris + l.dissipated + l.fracture + l.removed -
                                 m_world.elementsPut() - l.gravity - l.exchanged - l.placed);
    const double driven = m_case.impactor == Impactor::Kinematic
                              ? std::max(0.0, l.exchanged) + std::max(0.0, m_wholesDriven)
                              : 0;
    m_mostDriven = std::max(m_mostDriven, driven);
    const double put = m_put + l.gravity + l.placed + m_mostDriven;
    // All of one instant, which is half a substep before that of Bullet's velocities.
    const double held = l.kinetic + l.elastic + l.debris + rigidKinetic() + l.exchangedNext;
    m_mostPut = std::max({m_mostPut, put, m_put});
    m_outcome.energyPut = put;
    m_outcome.energyHeld = held;
    const double bar = kEnergyTolerance * m_mostPut + m_world.roundedEnergy();
    if (!m_pushedByBullet && held > put + bar)
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
    for (const btRigidBody* body : m_world.healthy())
      if (!isFinite(*body)) return violate("a rigid body is not finite");
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

  Case m_case;
  CaseWorld m_world;
  std::function<void(const std::string&)> m_trace;
  Outcome m_outcome;
  double m_put = 0;      // without gravity's work on elements, which the ledger has [J]
  double m_mostPut = 0;  // [J]
  double m_mostDriven = 0, m_wholesDriven = 0;
  bool m_pushedByBullet = false;
  std::map<std::uint32_t, std::vector<ElementPose>> m_places;
  WeightBooks m_weights;
};

}  // namespace

const char* nameOf(Outcome::Kind kind) {
  static constexpr std::array<const char*, 4> kNames = {"stable", "degraded", "refused", "stopped"};
  return kNames.at(std::size_t(kind));
}

Outcome run(const Case& c, const std::function<void(const std::string&)>& trace) {
  return Run(c, trace).take();
}

}  // namespace rubble::stability
