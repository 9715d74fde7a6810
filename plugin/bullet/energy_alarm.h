// Watches the border of Bullet and the elements, one rigid body at a time: elements get no more energy from a
// body than it does with its own motion. A static body can only take; one that the application moves gives by
// the motion it is given; a dynamic one gives what it lost of its own, as Bullet has it after the tick, and
// what Bullet's contacts, joints and the application did on it meanwhile.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "edem/rigid_proxy.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct TouchedBody;

class EnergyAlarm {
 public:
  /// Before the substeps: proxies as Bullet has the bodies.
  void begin(std::span<const edem::RigidProxy> proxies);
  /// After Bullet has moved its bodies. `energy` is the most that was in the world of elements [J]. Returns a
  /// line for each body that made more than kTolerance of it for the first time.
  std::vector<std::string> end(std::span<const TouchedBody> touched,
                               std::span<const edem::RigidProxy> proxies, double dt, double energy);

  /// The most that came from one body out of nothing, up to now [J]; and how many bodies were told of.
  double made() const { return m_made; }
  std::uint32_t told() const { return m_told; }
  /// The most kinetic energy of a rigid body that touched [J].
  double largestKinetic() const { return m_largestKinetic; }

  /// Share of the most energy that was in the world, rigid bodies that touch included.
  static constexpr double kTolerance = 0.05;

 private:
  struct Account {
    double surplus = 0;  // sum of RigidProxy::surplus: what contacts store or lose is below 0 [J]
    // What it gave in the substeps and Bullet did not take from it. What Bullet's own contacts took from it
    // is no credit for that: never below 0 [J].
    double unpaid = 0;
    bool told = false;
  };
  // As the body was before the substeps.
  struct Begun {
    Eigen::Vector3d position;
    Eigen::Matrix3d inertia;  // in the world's axes; 0 about an axis that it cannot turn about [kg m^2]
  };
  static double allowed(const TouchedBody& touched, const edem::RigidProxy& proxy, const Begun& begun,
                        double dt);

  std::vector<Begun> m_begun;                             // beside the proxies
  std::unordered_map<std::uint64_t, Account> m_accounts;  // by RigidProxy::key; looked up only
  double m_largestKinetic = 0;                            // of rigid bodies that touched [J]
  double m_made = 0;
  std::uint32_t m_told = 0;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
