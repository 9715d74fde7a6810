// What a grid's definition must say, and what follows from it.
#include "dust/definition.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// What the refusal says; empty if the definition was taken.
std::string refusal(const DustGridDef& def) {
  try {
    createDustGridCpu(def);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

TEST(DustDefinition, DefaultIsTaken) {
  const std::unique_ptr<DustGrid> grid = createDustGridCpu(DustGridDef{});
  EXPECT_STREQ(grid->backend(), "cpu");
  EXPECT_EQ(grid->cellCount(), 64u * 64 * 64);
  EXPECT_FLOAT_EQ(grid->cellSize().x(), 4.0f / 64);
  EXPECT_EQ(grid->densityBuffer(), 0u);
  EXPECT_EQ(grid->totals().error(), 0);
}

TEST(DustDefinition, RefusesResolutionsThatAreNoPowerOfTwoFrom8To256) {
  for (const int n : {-64, 0, 1, 4, 7, 12, 63, 100, 512}) {
    DustGridDef def;
    def.resolution = n;
    EXPECT_NE(refusal(def).find("resolution"), std::string::npos) << n;
  }
}

TEST(DustDefinition, RefusesBoxesWithoutVolume) {
  const std::vector<Eigen::Vector3f> corners = {{2, -1, 2}, {-3, 3, 2}, {2, kNan, 2}, {kInfinity, 3, 2}};
  for (const Eigen::Vector3f& max : corners) {
    DustGridDef def;
    def.max = max;
    EXPECT_NE(refusal(def).find("min, max"), std::string::npos) << max.transpose();
  }
}

TEST(DustDefinition, NamesTheValueItRefuses) {
  using Set = std::function<void(DustGridDef&, float)>;
  const std::vector<std::pair<std::string, Set>> keys = {
      {"grainRadius", [](DustGridDef& d, float v) { d.grainRadius = v; }},
      {"grainDensity", [](DustGridDef& d, float v) { d.grainDensity = v; }},
      {"airDensity", [](DustGridDef& d, float v) { d.airDensity = v; }},
      {"airViscosity", [](DustGridDef& d, float v) { d.airViscosity = v; }},
      {"gravity", [](DustGridDef& d, float v) { d.gravity = v; }},
      {"vorticity", [](DustGridDef& d, float v) { d.vorticity = v; }},
      {"drag", [](DustGridDef& d, float v) { d.drag = v; }}};
  for (const auto& [key, set] : keys) {
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, 1e9f}) {
      DustGridDef def;
      set(def, bad);
      EXPECT_NE(refusal(def).find(key), std::string::npos) << key << " " << bad;
    }
  }
}

TEST(DustDefinition, RefusesCyclesAndThreadsThatAreNone) {
  for (const int bad : {-1, 0, 1000}) {
    DustGridDef cycles, threads;
    cycles.pressureCycles = threads.threads = bad;
    EXPECT_NE(refusal(cycles).find("pressureCycles"), std::string::npos) << bad;
    EXPECT_NE(refusal(threads).find("threads"), std::string::npos) << bad;
  }
}

// 3 / (2 x 2400 kg/m^3 x 1e-6 m) = 625 m^2/kg, the geometric limit. It falls as 1 / R.
TEST(DustOptics, ConcreteAtOneMicrometreExtinguishes625SquareMetresAKilogram) {
  EXPECT_NEAR(double{massExtinction(2400, 1e-6f)}, 625, 1e-3);
  EXPECT_NEAR(double{massExtinction(2400, 10e-6f)}, 62.5, 1e-4);
}

// Stokes: 2/9 x 2398.8 x 9.81 x R^2 / 1.8e-5 gives 0.29 mm/s at 1 micrometre and 0.261 m/s at 30.
TEST(DustSettling, SpeedIsThatOfStokes) {
  DustGridDef def;
  EXPECT_NEAR(double{settlingSpeed(def)}, 2.905e-4, 1e-7);
  def.grainRadius = 30e-6f;
  EXPECT_NEAR(double{settlingSpeed(def)}, 0.26147, 1e-5);
  def.grainDensity = 1;  // lighter than air: it does not rise, it floats
  EXPECT_EQ(settlingSpeed(def), 0);
}

}  // namespace
}  // namespace rubble::test
