#include "rubble/limits.h"

#include "base/number_text.h"
#include "rubble/error.h"

namespace rubble {

std::string Limits::text() const {
  return base::numberText(low) + " to " + base::numberText(high);
}

void check(const Material& m) {
  const auto require = [&](bool holds, const char* field, double value, const std::string& allowed) {
    if (holds) return;
    throw Error("material " + m.name + ": " + field + ": " + base::numberText(value) +
                " is not allowed, must be " + allowed);
  };
  const auto within = [&](const Limits& limits, const char* field, double value, const char* unit) {
    require(limits.hold(value), field, value, limits.text() + unit);
  };
  within(limits::kDensity, "density", m.density, " kg/m^3");
  within(limits::kYoungsModulus, "youngsModulus", m.youngsModulus, " Pa");
  within(limits::kStrength, "tensileStrength", m.tensileStrength, " Pa");
  within(limits::kStrength, "compressiveStrength", m.compressiveStrength, " Pa");
  require(m.compressiveStrength >= m.tensileStrength, "compressiveStrength", m.compressiveStrength,
          "at least tensileStrength");
  within(limits::kBreakingAngle, "breakingAngle", m.breakingAngle, " rad");
  within(limits::kStretchThreshold, "stretchThreshold", m.stretchThreshold, "");
  within(limits::kSpringDamping, "springDamping", m.springDamping, "");
  within(limits::kContactStiffness, "contactStiffness", m.contactStiffness, "");
  within(limits::kContactDamping, "contactDamping", m.contactDamping, "");
  within(limits::kFriction, "friction", m.friction, "");
  within(limits::kRestitution, "restitution", m.restitution, "");
  within(limits::kRollingFriction, "rollingFriction", m.rollingFriction, "");
  within(limits::kBondWorkIndex, "bondWorkIndex", m.bondWorkIndex, " kWh/t");
  within(limits::kCrushEfficiency, "crushEfficiency", m.crushEfficiency, "");
  within(limits::kSizeModulus, "sizeModulus", m.sizeModulus, "");
  within(limits::kDustRadius, "dustRadius", m.dustRadius, " m");
  within(limits::kDebrisSpeed, "debrisSpeed", m.debrisSpeed, "");
}

}  // namespace rubble
