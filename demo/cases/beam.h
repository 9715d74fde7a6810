// The beam of the case `cantilever`, and what Bullet has for it beside its fixed constraint.
#pragma once

#include "demo/report_case.h"

namespace rubble::demo::cantilever {

inline constexpr double kLength = 1, kHeight = 0.1;  // [m]
inline constexpr double kDensity = 2400;             // [kg/m^3]
inline constexpr double kModulus = 300e6;            // [Pa]; the tip sags by 1.2 % of the length
inline constexpr double kGravity = 9.81;             // [m/s^2]
inline constexpr double kOuter = 0.9 * kLength;      // the sag is compared from here to the tip [m]

/// Of Bullet's methods, which start straight: so long they settle, until then they run [s].
inline constexpr double kSettling = 3, kSimulated = 4;

/// Cubes that Bullet's tetrahedra and springs are of.
inline constexpr int kAcross = 2, kAlong = 10 * kAcross;
inline constexpr double kCube = kHeight / kAcross;  // [m]

/// Mean of what places sag less or more than the beam, over the length.
class SagError {
 public:
  /// `x` from the root [m].
  void add(double x, double sag);
  double value() const;

 private:
  double m_sum = 0;
  int m_count = 0;
};

/// A btSoftBody of tetrahedra, two cubes of five through the height; `linear` is its kLST.
CaseOutcome runSoftBody(double rate, int iterations, double linear);

/// Cubes, two through the height, on a btGeneric6DofSpring2Constraint of E A / h at each face.
CaseOutcome runLattice(double rate, int iterations);

}  // namespace rubble::demo::cantilever
