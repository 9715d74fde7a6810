#include "demo/stability/stock_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "demo/stability/case_world.h"
#include "demo/stability/rigid_books.h"
#include "demo/stability/runner.h"

namespace rubble::stability {
namespace {

class StockRun {
 public:
  explicit StockRun(const Case& c) : m_case(c), m_world(c, Engine::Stock) {}

  StockOutcome take(int ticks) {
    m_world.build();
    m_put = kineticEnergy(m_world.moved());
    double time = 0;
    while (m_outcome.ticks < std::min(ticks, kMostTicks) && time < kLongest && m_outcome.violation.empty()) {
      const double dt = m_world.stepOf(m_outcome.ticks);
      if (m_outcome.ticks == kHappeningTick) happen();
      m_weights.begin(m_world.moved());
      m_world.step(dt);
      time += dt;
      ++m_outcome.ticks;
      judge(dt);
    }
    return m_outcome;
  }

 private:
  void happen() {
    const double before = kineticEnergy(m_world.moved());
    m_world.happen();
    m_put += std::max(0.0, kineticEnergy(m_world.moved()) - before);
  }

  void judge(double dt) {
    m_put += m_weights.work(m_world.moved(), m_case.gravity, dt);
    if (const btRigidBody* kinematic = m_world.kinematic())
      m_driven += contactWork(*kinematic, m_world.bullet().dispatcher);
    m_mostDriven = std::max(m_mostDriven, m_driven);
    const double put = m_put + m_mostDriven, held = kineticEnergy(m_world.moved());
    m_mostPut = std::max(m_mostPut, put);
    m_outcome.energyPut = put;
    m_outcome.energyHeld = held;
    for (const btRigidBody* body : m_world.healthy())
      if (!isFinite(*body)) return violate("a rigid body is not finite");
    // What the application put into the middle of another body is pushed out of it, here as there.
    if (m_case.happening == Happening::TeleportImpactor && m_outcome.ticks > kHappeningTick) return;
    if (!(held <= put + kEnergyTolerance * m_mostPut + m_world.roundedEnergy()))
      violate("holds " + std::to_string(held) + " J, put in were " + std::to_string(put) + " J, at most " +
              std::to_string(m_mostPut) + " J");
  }

  void violate(const std::string& what) { m_outcome.violation = what; }

  Case m_case;
  CaseWorld m_world;
  StockOutcome m_outcome;
  double m_put = 0;  // [J]
  double m_mostPut = 0;
  double m_driven = 0;
  double m_mostDriven = 0;
  WeightBooks m_weights;
};

}  // namespace

StockOutcome runStock(const Case& c, int ticks) {
  return StockRun(c).take(ticks);
}

}  // namespace rubble::stability
