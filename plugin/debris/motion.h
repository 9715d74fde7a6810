// Sums that the ledgers are made of: mass, momenta and kinetic energy of things, and what changes them.
// Angular momenta are about the world's origin; `angularAbout` shifts them, exactly, to any other point.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rubble::debris {

/// Largest magnitude of any number of a state, in its SI unit. Products of a few such numbers are finite, so
/// one check at the entrance keeps everything behind it finite.
inline constexpr double kLargest = 1e12;
/// Of a mass, inertia, volume or energy, which grow with the third to fifth power of a length: the largest
/// solid that is loaded has 2e22 kg and 2e34 kg m^2 (a diagonal of 1e6 m at 1e5 kg/m^3). Products hold at
/// most three of them beside six other numbers, 1e192 of a double's 1e308; and each is a float.
inline constexpr double kLargestAmount = 1e38;

/// True when no component is NaN, infinite or beyond kLargest.
inline bool isUsable(const Eigen::Vector3d& v) {
  return (v.array().abs() <= kLargest).all();
}

/// Mass and motion of any number of bodies.
struct Motion {
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< momentum [kg m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< momentum about the world's origin [kg m^2/s]
  double kinetic = 0;                                 ///< energy, spin included [J]

  Eigen::Vector3d angularAbout(const Eigen::Vector3d& origin) const { return angular - origin.cross(linear); }

  Motion& operator+=(const Motion& other) {
    mass += other.mass;
    linear += other.linear;
    angular += other.angular;
    kinetic += other.kinetic;
    return *this;
  }
  Motion& operator-=(const Motion& other) {
    mass -= other.mass;
    linear -= other.linear;
    angular -= other.angular;
    kinetic -= other.kinetic;
    return *this;
  }
};

/// Motion of one body of scalar inertia [kg m^2] about its centre.
inline Motion motionOf(double mass, double inertia, const Eigen::Vector3d& position,
                       const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) {
  const Eigen::Vector3d linear = mass * velocity;
  return {mass, linear, position.cross(linear) + inertia * spin,
          0.5 * (linear.dot(velocity) + inertia * spin.squaredNorm())};
}

/// A change of motion: impulse [N s], angular impulse about the world's origin [N m s], kinetic energy [J].
struct Impulse {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  double energy = 0;

  Eigen::Vector3d angularAbout(const Eigen::Vector3d& origin) const { return angular - origin.cross(linear); }

  Impulse& operator+=(const Impulse& other) {
    linear += other.linear;
    angular += other.angular;
    energy += other.energy;
    return *this;
  }
};

/// From `before` to `after`.
inline Impulse changeOf(const Motion& before, const Motion& after) {
  return {after.linear - before.linear, after.angular - before.angular, after.kinetic - before.kinetic};
}

}  // namespace rubble::debris
