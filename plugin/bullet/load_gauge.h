// How near to its strength the loads that rest on it bring a body that Bullet moves as a whole: beam theory
// on plane cuts, on numbers.
#pragma once

#include <array>
#include <span>

#include "bullet/contact_patch.h"
#include "bullet/sections.h"
#include "rubble/abi.h"
#include "rubble/material.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// What acts on a body in one tick, in the axes and about the origin of its sections.
struct RestingLoad {
  std::span<const ContactPatch> contacts;
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s^2]; of a body that anchors hold
  bool held = false;                                  ///< by anchors, which take all that acts on it
};

class LoadGauge {
 public:
  LoadGauge(Sections sections, const Material& material, const Model& model);

  /// Counts on what acts in a tick of `dt` seconds.
  void note(const RestingLoad& load, double dt);
  /// Forgets what it has seen.
  void reset();
  /// Largest stress over strength of what has been acting for about 0.1 s; dimensionless.
  double share() const { return m_share; }
  /// About the frequency of the body's slowest bending, were it alone [rad/s].
  double slowestBending() const { return m_slowest; }

 private:
  double sectionShare(const Section& cut, const Wrench& load) const;

  Sections m_sections;
  double m_tension = 0, m_compression = 0, m_cohesion = 0, m_friction = 0;  // [Pa], [Pa], [Pa], 1
  double m_slowest = 0;
  std::array<Wrench, kCuts> m_loads;  // on what lies beyond each cut, smoothed
  double m_bearing = 0;               // smoothed [Pa]
  double m_share = 0;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
