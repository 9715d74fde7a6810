// What both back ends share of the public interface: checks of the definition, sizes, optics.
#include <algorithm>
#include <cmath>
#include <string>

#include "dust/definition.h"
#include "rubble/dust.h"
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

void checkRange(const char* key, float value, float low, float high, const char* allowed) {
  if (!(value >= low && value <= high)) refuse(key, std::to_string(value), allowed);
}

}  // namespace

void checkDefinition(const DustGridDef& def) {
  const int n = def.resolution;
  if (n < 8 || n > 256 || (n & (n - 1)) != 0) {
    refuse("resolution", std::to_string(n), "8, 16, 32, 64, 128, 256");
  }
  const Eigen::Vector3f size = def.max - def.min;
  if (!def.min.allFinite() || !def.max.allFinite() ||
      !(size.minCoeff() >= 1e-3f && size.maxCoeff() <= 1e5f)) {
    refuse("min, max", "the box", "finite corners, each side 1e-3 to 1e5 m, max above min");
  }
  checkRange("grainRadius", def.grainRadius, 1e-9f, 1e-2f, "1e-9 to 1e-2 m");
  checkRange("grainDensity", def.grainDensity, 1, 1e5f, "1 to 1e5 kg/m^3");
  checkRange("airDensity", def.airDensity, 1e-3f, 1e3f, "1e-3 to 1e3 kg/m^3");
  checkRange("airViscosity", def.airViscosity, 1e-7f, 1, "1e-7 to 1 Pa s");
  checkRange("gravity", def.gravity, 0, 1e3f, "0 to 1e3 m/s^2");
  checkRange("vorticity", def.vorticity, 0, 1, "0 to 1");
  checkRange("drag", def.drag, 0, 1e3f, "0 to 1e3 1/s");
  if (def.pressureCycles < 1 || def.pressureCycles > 50) {
    refuse("pressureCycles", std::to_string(def.pressureCycles), "1 to 50");
  }
  if (def.threads < 1 || def.threads > 256) refuse("threads", std::to_string(def.threads), "1 to 256");
}

float settlingSpeed(const DustGridDef& def) {
  const float r = def.grainRadius;
  const float difference = std::max(def.grainDensity - def.airDensity, 0.0f);
  return std::min(2.0f / 9.0f * difference * def.gravity * r * r / def.airViscosity, shared::kDustMaxSpeed);
}

}  // namespace dust
}  // namespace rubble
