// A bar hung by its top, as elements and as a chain of Bullet's.
#pragma once

#include "demo/cases/case_world.h"

namespace rubble::demo::bar {

inline constexpr double kLength = 1, kWidth = 0.1;                      // [m]
inline constexpr double kDensity = 2400, kModulus = 30e6;               // [kg/m^3], [Pa]; sound takes 8.9 ms
inline constexpr double kGravity = 9.81;                                // [m/s^2]; the tip sinks by 0.04 %
inline constexpr double kOuter = 0.9 * kLength;                         // looked at from here to the tip [m]
inline constexpr std::size_t kCoarse = 80, kMiddle = 270, kFine = 640;  // elements: 2, 3, 4 across

/// From y = L / 2 down to -L / 2, tied at the top; springs that do not break.
DestructibleBodyDef elements(std::size_t count);

/// Mean distance from the top of what lies in the outer tenth at rest [m], and of what it sinks by.
struct Outer {
  double depth, sink;
};
Outer outerOf(const DestructibleBody& body);

/// Twenty boxes from y = 0 down, each on a btGeneric6DofSpring2Constraint of E A / h along the bar; Bullet
/// lowers a stiffness that its step is too long for.
class Chain {
 public:
  /// `damping` is the share of its speed that a box loses in a second.
  Chain(CaseWorld& world, int iterations, double damping = 0);
  /// Of its last two boxes.
  Outer outer() const;

 private:
  std::vector<btRigidBody*> m_boxes;
};

}  // namespace rubble::demo::bar
