#include "edem/testing_machine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edem/stable_step.h"

namespace rubble::edem {
namespace {

// Which face of the cube across z a cell reaches: -1, 1, or 0 for none.
int endOf(const Asset& asset, std::size_t element) {
  for (const CellFace& face : asset.cellFaces(element))
    if (face.neighbour == kNoElement && std::abs(face.normal.z()) > 0.9f) return face.normal.z() < 0 ? -1 : 1;
  return 0;
}

BodyDef freeBody(const TestCube& cube, const Material& material) {
  BodyDef def;
  def.asset = cube.asset;
  def.material = material;
  def.anchored = false;
  return def;
}

}  // namespace

TestingMachine::TestingMachine(TestCube cube, const Material& material, Plates plates, double speed)
    : m_cube(std::move(cube)), m_one(freeBody(m_cube, material)), m_plates(plates), m_speed(speed) {
  Body<double>& body = m_one.body();
  const auto constants = std::make_shared<BodyConstants<double>>(*body.constants);
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    body.state.velocity[i] = Eigen::Vector3d(0, 0, velocityOf(i));  // no blow at the start
    const int end = endOf(*m_cube.asset, i);
    if (end == 0) continue;
    m_held.push_back({i, double(end)});
    if (plates == Plates::Greased) continue;
    constants->inverseMass[i] = 0;  // held by what is infinitely heavy
    constants->inverseInertia[i] = 0;
  }
  body.constants = constants;
  std::vector<ElementRates> rates(body.elementCount());
  springRates(body, std::span(rates));
  const double bound = springBound(body, std::span<const ElementRates>(rates)).stableStep();
  m_step = 0.7 * bound;  // the contacts of broken pairs need some of it
  const double echo = 2 * m_cube.edge / std::sqrt(material.youngsModulus / material.density);
  m_stepsPerReading = int(std::ceil(echo / m_step));
}

double TestingMachine::read(bool breaking) {
  double force = 0;
  for (int s = 0; s < m_stepsPerReading; ++s) {
    m_one.substep(m_step, breaking);
    for (const Held& h : m_held) force -= h.end * m_one.body().work.force[h.element].z();
    if (m_plates == Plates::Greased) guide();
  }
  m_time += m_stepsPerReading * m_step;
  return force / (2 * m_stepsPerReading) / (m_cube.edge * m_cube.edge);
}

double TestingMachine::velocityOf(std::uint32_t i) const {
  return m_speed * m_cube.asset->positions[i].z() / m_cube.edge;
}

// Puts the held cells back on their way along z, and their faces flat on the plates.
void TestingMachine::guide() {
  Body<double>& body = m_one.body();
  for (const Held& h : m_held) {
    const std::uint32_t i = h.element;
    body.state.displacement[i].z() += m_step * (velocityOf(i) - body.state.velocity[i].z());
    body.state.velocity[i].z() = velocityOf(i);
    body.state.velocityCarry[i].z() = 0;
    body.state.spin[i].head<2>().setZero();
    body.state.rotation[i] =
        Quat<double>(body.state.rotation[i].w(), 0, 0, body.state.rotation[i].z()).normalized();
  }
}

double strengthOf(const TestCube& cube, const Material& material, Plates plates, double speed,
                  double strainEnd) {
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

double modulusOf(const TestCube& cube, const Material& material, double speed) {
  constexpr int kReadings = 20;
  TestingMachine machine(cube, material, Plates::Greased, speed);
  double stress = 0, strain = 0;
  for (int n = 0; n < kReadings; ++n) {
    // The mean over a reading is the stress at its middle.
    const double before = machine.strain();
    stress = machine.read(false);
    strain = 0.5 * (before + machine.strain());
  }
  return stress / strain;
}

}  // namespace rubble::edem
