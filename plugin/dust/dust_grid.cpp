// What both back ends share of the public interface: checks of the definition, sizes, optics.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/number_text.h"
#include "dust/definition.h"
#include "rubble/dust.h"
#include "rubble/limits.h"
#include "shared/dust.h"

namespace rubble {

double DustTotals::error() const {
  return emitted > 0 ? std::abs(emitted - air - settled - left) / emitted : 0;
}

std::size_t DustGrid::cellCount() const {
  const auto n = std::size_t(m_def.resolution);
  return n * n * n;
}

Eigen::Vector3f DustGrid::cellSize() const {
  return (m_def.max - m_def.min) / float(m_def.resolution);
}

float massExtinction(float grainDensity, float grainRadius) {
  return 3 / (2 * grainDensity * grainRadius);
}

namespace dust {

namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw Error("dust: " + key + ": " + value + " is out of range; allowed: " + allowed);
}

template <class Number>
void checkRange(const char* key, Number value, const Limits& limits, const char* unit) {
  if (!limits.hold(value)) refuse(key, base::numberText(value), limits.text() + unit);
}

}  // namespace

void checkDefinition(const DustGridDef& def) {
  const int n = def.resolution;
  if (!limits::kDustResolution.hold(n) || (n & (n - 1)) != 0) {
    refuse("resolution", std::to_string(n), "a power of two, " + limits::kDustResolution.text());
  }
  const Eigen::Vector3f size = def.max - def.min;
  if (!def.min.allFinite() || !def.max.allFinite() || !limits::kDustSide.hold(size.minCoeff()) ||
      !limits::kDustSide.hold(size.maxCoeff())) {
    refuse("min, max", "the box",
           "finite corners, each side " + limits::kDustSide.text() + " m, max above min");
  }
  checkRange("grainRadius", def.grainRadius, limits::kDustRadius, " m");
  checkRange("grainDensity", def.grainDensity, limits::kDensity, " kg/m^3");
  checkRange("airDensity", def.airDensity, limits::kAirDensity, " kg/m^3");
  checkRange("airViscosity", def.airViscosity, limits::kAirViscosity, " Pa s");
  checkRange("gravity", def.gravity, limits::kDustGravity, " m/s^2");
  checkRange("vorticity", def.vorticity, limits::kVorticity, "");
  checkRange("drag", def.drag, limits::kDustDrag, " 1/s");
  checkRange("pressureCycles", def.pressureCycles, limits::kPressureCycles, "");
  checkRange("threads", def.threads, limits::kDustThreads, "");
}

float settlingSpeed(const DustGridDef& def) {
  const float r = def.grainRadius;
  const float difference = std::max(def.grainDensity - def.airDensity, 0.0f);
  return std::min(2.0f / 9.0f * difference * def.gravity * r * r / def.airViscosity, shared::kDustMaxSpeed);
}

}  // namespace dust
}  // namespace rubble
