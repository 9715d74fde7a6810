// Which numbers the library takes. Its own checks read these constants, and so can an application that reads
// numbers from a file, so that nothing passes there and is refused here. SI units.
#pragma once

#include <string>
#include <type_traits>

#include "rubble/material.h"

namespace rubble {

/// Limits of a number; both ends are allowed.
struct Limits {
  double low, high;

  /// False for NaN too. A float is compared with the ends as floats.
  template <class Number>
  constexpr bool hold(Number value) const {
    if constexpr (std::is_same_v<Number, float>) return value >= float(low) && value <= float(high);
    return double(value) >= low && double(value) <= high;
  }
  /// "0 to 0.5"
  std::string text() const;
};

namespace limits {

// Lengths and places. Beyond, a float holds no centimetres; below, no cell of an element.
inline constexpr Limits kLength = {1e-4, 1e5};      ///< edges and radii of solids [m]
inline constexpr Limits kPosition = {-1e5, 1e5};    ///< each coordinate of a body at the start [m]
inline constexpr Limits kSpeed = {-1e4, 1e4};       ///< each component at the start [m/s]
inline constexpr Limits kSpin = {-1e4, 1e4};        ///< each component at the start [rad/s]
inline constexpr Limits kGravity = {-1e3, 1e3};     ///< each component [m/s^2]
inline constexpr Limits kMassDamping = {0, 1e4};    ///< DestructibleBodyDef::massDamping [1/s]
inline constexpr Limits kElements = {1, 1e7};       ///< CookOptions::elements
inline constexpr Limits kElementRadius = {0, 1e5};  ///< CookOptions::radius [m]; 0 is chosen
inline constexpr Limits kFill = {0.3, 0.6};         ///< CookOptions::fill

// Material, field by field. Lower ends keep divisions finite.
inline constexpr Limits kDensity = {1, 1e5};              ///< [kg/m^3]
inline constexpr Limits kYoungsModulus = {1, 1e13};       ///< [Pa]; diamond has 1e12
inline constexpr Limits kStrength = {0, 1e13};            ///< tensile and compressive [Pa]
inline constexpr Limits kBreakingAngle = {1e-9, 3.2};     ///< [rad]; a half turn is 3.14
inline constexpr Limits kStretchThreshold = {0, 1e6};     ///< dimensionless
inline constexpr Limits kSpringDamping = {0, 0.5};        ///< dimensionless
inline constexpr Limits kContactStiffness = {1e-6, 100};  ///< dimensionless
inline constexpr Limits kContactDamping = {0, 1};         ///< dimensionless
inline constexpr Limits kFriction = {0, 10};              ///< dimensionless
inline constexpr Limits kRollingFriction = {0, 1};        ///< dimensionless
inline constexpr Limits kRestitution = {0, 1};            ///< dimensionless
inline constexpr Limits kBondWorkIndex = {1e-6, 1e4};     ///< [kWh/t]
inline constexpr Limits kCrushEfficiency = {1e-9, 1};     ///< dimensionless
inline constexpr Limits kSizeModulus = {0.05, 1};         ///< dimensionless
inline constexpr Limits kDustRadius = {1e-9, 1e-2};       ///< [m]
inline constexpr Limits kDebrisSpeed = {0, 100};          ///< dimensionless

// DestructionDef
inline constexpr Limits kMaxSubstepsPerFrame = {1, 1e7};
inline constexpr Limits kSubstepSafety = {1e-3, 1};
inline constexpr Limits kMaxDebris = {1, 1 << 24};  ///< a float counts no further
inline constexpr Limits kMaxEvents = {1, 1e8};

// DustGridDef. The grain's density and radius are those of the material.
inline constexpr Limits kDustResolution = {8, 256};  ///< a power of two
inline constexpr Limits kDustSide = {1e-3, 1e5};     ///< of the grid's box, each [m]
inline constexpr Limits kAirDensity = {1e-3, 1e3};   ///< [kg/m^3]
inline constexpr Limits kAirViscosity = {1e-7, 1};   ///< [Pa s]
inline constexpr Limits kDustGravity = {0, 1e3};     ///< along -y [m/s^2]
inline constexpr Limits kVorticity = {0, 1};         ///< dimensionless
inline constexpr Limits kDustDrag = {0, 1e3};        ///< [1/s]
inline constexpr Limits kPressureCycles = {1, 50};
inline constexpr Limits kDustThreads = {1, 256};

// Drawing
inline constexpr Limits kDustOpacity = {0, 1000};   ///< DustLook::opacity, dimensionless
inline constexpr Limits kFieldOfView = {0.1, 179};  ///< Camera::verticalFov, here in degrees

}  // namespace limits

/// Throws rubble::Error that names the field of the material which is out of its limits.
void check(const Material& material);

}  // namespace rubble
