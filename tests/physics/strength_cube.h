// A packed cube in a testing machine: pulled, or pressed, along z. Slow, without gravity.
#pragma once

#include <algorithm>
#include <map>

#include "edem/stable_step.h"
#include "physics/bodies.h"
#include "rubble/cook.h"
#include "support/strict_cook.h"

namespace rubble::test {

inline constexpr double kCubeEdge = 0.3;  // [m]

/// A cube about the origin. Each is cooked once.
inline std::shared_ptr<const Asset> packedCube(std::size_t elements, std::uint64_t seed) {
  static std::map<std::pair<std::size_t, std::uint64_t>, std::shared_ptr<const Asset>> cooked;
  std::shared_ptr<const Asset>& asset = cooked[{elements, seed}];
  if (!asset) {
    CookOptions options;
    options.elements = elements;
    options.seed = seed;
    asset =
        std::make_shared<const Asset>(cookStrictly(boxMesh(Eigen::Vector3d::Constant(kCubeEdge)), options));
  }
  return asset;
}

/// Which face of the cube across z a cell reaches: -1, 1, or 0 for none.
inline int endOf(const Asset& asset, std::size_t element) {
  for (const CellFace& face : asset.cellFaces(element))
    if (face.neighbour == kNoElement && std::abs(face.normal.z()) > 0.9f) return face.normal.z() < 0 ? -1 : 1;
  return 0;
}

/// How the machine's flat plates hold the cells at the cube's two ends. Either way the cells' faces follow
/// the plates.
enum class Plates {
  Glued,   ///< nothing of them moves by itself
  Greased  ///< they slide along the plates and turn about z freely
};

/// The machine. Within the end cells the strain is that of the whole cube, so that they load the rest evenly.
class TestingMachine {
 public:
  /// `speed` is that of the plates away from each other [m/s].
  TestingMachine(std::shared_ptr<const Asset> asset, const Material& material, Plates plates, double speed)
      : m_asset(std::move(asset)), m_one(bodyDef(m_asset, material)), m_plates(plates), m_speed(speed) {
    edem::Body<double>& body = m_one.body();
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
      body.velocity[i] = Eigen::Vector3d(0, 0, velocityOf(i));  // no blow at the start
      const int end = endOf(*m_asset, i);
      if (end == 0) continue;
      m_held.push_back({i, double(end)});
      if (plates == Plates::Greased) continue;
      body.inverseMass[i] = 0;
      body.inverseInertia[i] = 0;
    }
    std::vector<edem::ElementRates> rates(body.elementCount());
    edem::springRates(body, std::span(rates));
    const double bound = edem::springBound(body, std::span<const edem::ElementRates>(rates)).stableStep();
    m_step = 0.7 * bound;  // the contacts of broken pairs need some of it
    const double echo = 2 * kCubeEdge / std::sqrt(material.youngsModulus / material.density);
    m_stepsPerReading = int(std::ceil(echo / m_step));
  }

  /// Mean stress on the cross-section, positive in tension, over the time that sound takes there and back
  /// [Pa].
  double read(bool breaking = true) {
    double force = 0;
    for (int s = 0; s < m_stepsPerReading; ++s) {
      m_one.substep(m_step, breaking);
      for (const Held& h : m_held) force -= h.end * m_one.body().force[h.element].z();
      if (m_plates == Plates::Greased) guide();
    }
    m_time += m_stepsPerReading * m_step;
    return force / (2 * m_stepsPerReading) / (kCubeEdge * kCubeEdge);
  }
  /// Now; positive in tension.
  double strain() const { return m_speed * m_time / kCubeEdge; }
  std::uint32_t broken() { return m_one.body().brokenCount; }

 private:
  struct Held {
    std::uint32_t element;
    double end;  // -1 or 1
  };

  static edem::BodyDef bodyDef(const std::shared_ptr<const Asset>& asset, const Material& material) {
    edem::BodyDef def;
    def.asset = asset;
    def.material = material;
    def.anchored = false;
    return def;
  }
  double velocityOf(std::uint32_t i) const { return m_speed * m_asset->positions[i].z() / kCubeEdge; }
  // Puts the held cells back on their way along z, and their faces flat on the plates.
  void guide() {
    edem::Body<double>& body = m_one.body();
    for (const Held& h : m_held) {
      const std::uint32_t i = h.element;
      body.displacement[i].z() += m_step * (velocityOf(i) - body.velocity[i].z());
      body.velocity[i].z() = velocityOf(i);
      body.velocityCarry[i].z() = 0;
      body.spin[i].head<2>().setZero();
      body.rotation[i] = edem::Quat<double>(body.rotation[i].w(), 0, 0, body.rotation[i].z()).normalized();
    }
  }

  std::shared_ptr<const Asset> m_asset;
  OneBody<double> m_one;
  Plates m_plates;
  double m_speed;
  std::vector<Held> m_held;
  double m_step = 0;
  int m_stepsPerReading = 0;
  double m_time = 0;
};

/// Largest stress that the cube carries before it has lost half of it, or until the strain is `strainEnd`
/// [Pa]. Speed < 0 presses.
inline double strengthOf(const std::shared_ptr<const Asset>& cube, const Material& material, Plates plates,
                         double speed, double strainEnd) {
  TestingMachine machine(cube, material, plates, speed);
  const double side = speed < 0 ? -1 : 1;
  double peak = 0;
  while (std::abs(machine.strain()) < strainEnd) {
    const double stress = side * machine.read();
    peak = std::max(peak, stress);
    if (machine.broken() > 0 && stress < 0.5 * peak) break;
  }
  return peak;
}

}  // namespace rubble::test
