#include "bullet/energy_alarm.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

double kinetic(double mass, const Eigen::Matrix3d& inertia, const btVector3& velocity,
               const btVector3& spin) {
  const Eigen::Vector3d v = toEigen(velocity), w = toEigen(spin);
  return 0.5 * (mass * v.squaredNorm() + w.dot(inertia * w));
}

// World axes; 0 about an axis that it cannot turn about.
Eigen::Matrix3d inertiaOf(const edem::RigidProxy& proxy) {
  if (proxy.mobility)
    return proxy.mobility->bottomRightCorner<3, 3>().completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
  const Eigen::Vector3d inertia =
      proxy.inverseInertia.unaryExpr([](double inverse) { return inverse > 0 ? 1 / inverse : 0; });
  return turn * inertia.asDiagonal() * turn.transpose();
}

}  // namespace

void EnergyAlarm::begin(std::span<const edem::RigidProxy> proxies) {
  m_begun.clear();
  for (const edem::RigidProxy& proxy : proxies) {
    m_begun.push_back({proxy.position, inertiaOf(proxy)});
  }
}

// What a dynamic body may have given in this tick: what it lost, with the work of all others on it.
double EnergyAlarm::allowed(const TouchedBody& t, const edem::RigidProxy& proxy, const Begun& begun,
                            double dt) {
  const double mass = 1 / double(t.rigid->getInvMass());
  const Eigen::Vector3d v0 = toEigen(t.velocity), v1 = toEigen(t.rigid->getLinearVelocity()),
                        w0 = toEigen(t.spin), w1 = toEigen(t.rigid->getAngularVelocity()),
                        a = toEigen(t.acceleration), turning = toEigen(t.angularAcceleration);
  const double lost = 0.5 * (mass * (v0 - v1).dot(v0 + v1) + (w0 - w1).dot(begun.inertia * (w0 + w1)));
  // Of its weight and the application's forces: by its mean motion, or as the substeps had it when it was hit
  // early or late in the tick.
  Eigen::Vector3d moved = proxy.position - begun.position;
  if (t.held) moved.setZero();
  const double applied = mass * std::max(a.dot(moved), 0.5 * dt * a.dot(v0 + v1)) +
                         0.5 * dt * turning.dot(begun.inertia * (w0 + w1));
  // Of contacts and joints. What they take is no loss to the elements.
  const Eigen::Vector3d push = v1 - v0 - toEigen(t.deltaVelocity - t.supported) - dt * a,
                        twist = w1 - w0 - toEigen(t.deltaSpin - t.supportedSpin) - dt * turning;
  const double others = 0.5 * (mass * push.dot(v0 + v1) + twist.dot(begun.inertia * (w0 + w1)));
  return lost + applied + std::max(others, 0.0);
}

std::vector<std::string> EnergyAlarm::end(std::span<const TouchedBody> touched,
                                          std::span<const edem::RigidProxy> proxies, double dt,
                                          double energy) {
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    const TouchedBody& t = touched[p];
    if (!t.rigid || !proxies[p].isPressed()) continue;
    m_largestKinetic = std::max(
        m_largestKinetic, kinetic(1 / double(t.rigid->getInvMass()), m_begun[p].inertia, t.velocity, t.spin));
  }
  const double bar = kTolerance * (energy + m_largestKinetic);
  std::vector<std::string> lines;
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    const edem::RigidProxy& proxy = proxies[p];
    const auto known = m_accounts.find(proxy.key);
    if (known == m_accounts.end() && !proxy.isPressed()) continue;
    Account& account = known == m_accounts.end() ? m_accounts[proxy.key] : known->second;
    account.surplus += proxy.surplus;
    if (touched[p].rigid && proxy.isPressed()) {
      const double unpaid = proxy.given - allowed(touched[p], proxy, m_begun[p], dt);
      account.unpaid = std::max(account.unpaid + unpaid, 0.0);
    }
    const double made = account.surplus + account.unpaid;
    m_made = std::max(m_made, made);
    if (account.told || !(made > bar)) continue;
    account.told = true;
    ++m_told;
    const Eigen::Vector3d& at = proxy.position;
    char line[300];
    std::snprintf(
        line, sizeof line,
        "elements got %.3g J more from the %s body at (%.3g, %.3g, %.3g) than it gave; at most %.3g J "
        "were in the world, of which %.0f %% may come of rounding and long ticks",
        made,
        touched[p].rigid  ? "dynamic"
        : proxy.kinematic ? "kinematic"
                          : "static",
        at.x(), at.y(), at.z(), energy + m_largestKinetic, 100 * kTolerance);
    lines.emplace_back(line);
  }
  return lines;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
