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

/// What of a body's contacts tells whether its load has changed: moments of their pressing impulses over
/// place, in a frame of the body's.
struct Pressure {
  double sum = 0;                                     ///< [N s]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();    ///< [N s m]
  Eigen::Vector3d second = Eigen::Vector3d::Zero();   ///< of the coordinates' squares [N s m^2]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< that anchors hold against [m/s^2]
  void add(double impulse, const Eigen::Vector3d& at);
};

class LoadGauge {
 public:
  LoadGauge(Sections sections, const Material& material, const Model& model);

  /// Counts on what acts in a tick of `dt` seconds.
  void note(const RestingLoad& load, double dt);
  /// True while note() would change nothing that matters: the share is far from a thaw, and the contacts,
  /// given in a tick of `dt` seconds, have pressed alike for long.
  bool isSettled(const Pressure& contacts, double spin, double dt);
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
  Pressure m_seen;        // when the load last changed, over the tick
  double m_settling = 0;  // since then [s]
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
