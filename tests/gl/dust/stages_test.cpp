// Each stage alone, from the same state on both back ends.
//
// kRounding: a stage is at most some tens of operations on each value; they may be rounded in another order
// (fused multiply-add, another sqrt), each by 6e-8 of the largest operand. A mistake in a kernel shows at
// 1e-2 and more.
#include "gl/dust/both.h"

namespace rubble::test {
namespace {

using dust::Field;
constexpr double kRounding = 4e-6;

class DustKernel : public Both {
 protected:
  void prepare() override { start(grid()); }

  // Swirls of several metres a second and a cloud, smooth so that the comparison is not about limiters'
  // kinks.
  void start(const DustGridDef& def, float speed = 3) {
    make(def);
    const int n = def.resolution;
    std::vector<float> velocity, density;
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          const auto at = [n](int i, float waves, float phase) {
            return std::sin(6.2832f * waves * (float(i) + 0.5f) / float(n) + phase);
          };
          velocity.insert(velocity.end(),
                          {speed * at(y, 1, 0.3f) * at(z, 2, 1), speed * at(x, 2, 0) * at(z, 1, 2),
                           speed * at(x, 1, 1.5f) * at(y, 3, 0.2f), 0});
          density.push_back(std::max(0.0f, 2 * at(x, 1, 0) * at(y, 1.5f, 1) * at(z, 1, 2)));
        }
      }
    }
    write(Field::Velocity, velocity);
    write(Field::Density, density);
  }

  static std::vector<dust::SolidCells> solids() {
    DustObstacle ball, box;
    ball.position = {0.4f, 1.1f, 0.3f};
    ball.halfExtents.x() = 0.61f;
    ball.velocity = {1, 0.5f, -2};
    ball.spin = {0, 3, 1};
    box.kind = DustObstacle::Kind::Box;
    box.position = {0.9f, 1.0f, 0.5f};  // over the ball: the later one wins
    box.orientation = Eigen::AngleAxisf(0.5f, Eigen::Vector3f(1, 2, 3).normalized());
    box.halfExtents = {0.7f, 0.21f, 0.43f};
    box.spin = {-2, 0, 1};
    std::vector<dust::SolidCells> cells;
    dust::gatherSolids(dust::Lattice(grid()), std::vector<DustObstacle>{ball, box}, cells);
    return cells;
  }
  template <class Stage>
  void onBoth(Stage&& stage) {
    stage(static_cast<dust::Stages&>(*m_cpu));
    stage(static_cast<dust::Stages&>(*m_gl));
  }
  void place() {
    const auto list = solids();
    onBoth([&](dust::Stages& s) { s.placeObstacles(list); });
  }
  void carryCpuState() {
    for (Field f : {Field::Velocity, Field::Density, Field::Faces, Field::Divergence}) m_gl->write(f, cpu(f));
  }
};

TEST_F(DustKernel, SourcesAddTheirDustAndSetTheVelocity) {
  const std::vector<shared::DustSourceCell> sources = {{{1, 2, 3, 0.5f}, 77, 0, 0, 0},
                                                       {{-4, 0, 1, 2.5f}, 32767, 0, 0, 0}};
  onBoth([&](dust::Stages& s) { s.addSources(sources); });
  EXPECT_EQ(cpu(Field::Density), gl(Field::Density));
  EXPECT_EQ(cpu(Field::Velocity), gl(Field::Velocity));
  EXPECT_EQ(gl(Field::Velocity)[4 * 32767], -4);
}

TEST_F(DustKernel, ForcesAreThoseOfTheCpu) {
  onBoth([](dust::Stages& s) { s.addForces(kStep); });
  expectSame(Field::Velocity, kRounding);
}

TEST_F(DustKernel, ForcesWithoutConfinementAreThoseOfTheCpu) {
  DustGridDef def = grid();
  def.vorticity = 0;
  start(def);
  onBoth([](dust::Stages& s) { s.addForces(kStep); });
  expectSame(Field::Velocity, kRounding);
}

TEST_F(DustKernel, ObstaclesCoverTheSameCells) {
  place();
  const std::vector<float> air = cpu(Field::Air);
  EXPECT_EQ(air, gl(Field::Air));
  EXPECT_GT(std::count(air.begin(), air.end(), 0.0f), 300);
  expectSame(Field::Velocity, kRounding);
  onBoth([](dust::Stages& s) { s.placeObstacles({}); });  // and leave them again
  EXPECT_EQ(gl(Field::Air), std::vector<float>(air.size(), 1.0f));
}

TEST_F(DustKernel, FacesAndDivergenceAreThoseOfTheCpu) {
  place();
  carryCpuState();
  onBoth([](dust::Stages& s) { s.computeDivergence(); });
  expectSame(Field::Faces, kRounding);
  expectSame(Field::Divergence, kRounding);
}

// The errors of the sweeps add up over the levels of a cycle, and those of long waves are larger than the
// residual by up to n^2 / 10. Measured: 2e-6 of the largest pressure.
TEST_F(DustKernel, PressureIsThatOfTheCpuInOpenAir) {
  onBoth([](dust::Stages& s) { s.placeObstacles({}); });
  onBoth([](dust::Stages& s) { s.computeDivergence(); });
  carryCpuState();
  onBoth([](dust::Stages& s) { s.solvePressure(); });
  expectSame(Field::Pressure, 2e-5);
}

TEST_F(DustKernel, PressureIsThatOfTheCpuAroundSolids) {
  place();
  onBoth([](dust::Stages& s) { s.computeDivergence(); });
  carryCpuState();
  onBoth([](dust::Stages& s) { s.solvePressure(); });
  expectSame(Field::Pressure, 2e-5);
}

TEST_F(DustKernel, ProjectionIsThatOfTheCpu) {
  place();
  onBoth([](dust::Stages& s) { s.computeDivergence(); });
  carryCpuState();
  onBoth([](dust::Stages& s) {
    s.solvePressure();
    s.project();
  });
  expectSame(Field::Faces, 2e-5);  // as the pressure, whose gradient it takes
  expectSame(Field::Velocity, 2e-5);
}

// Where a point comes from is rounded to 2e-6 cells (of 32), and the velocity changes by up to its scale a
// cell.
TEST_F(DustKernel, AdvectionIsThatOfTheCpu) {
  for (float speed : {3.0f, 60.0f}) {
    start(grid(), speed);
    onBoth([](dust::Stages& s) { s.advectVelocity(kStep); });
    expectSame(Field::Velocity, 1e-5);
  }
}

// One substep, several, and the most there are.
TEST_F(DustKernel, TransportIsThatOfTheCpu) {
  for (float speed : {3.0f, 30.0f, 300.0f}) {
    start(grid(), speed);
    place();
    carryCpuState();
    onBoth([](dust::Stages& s) { s.computeDivergence(); });
    m_gl->write(Field::Faces, cpu(Field::Faces));
    onBoth([](dust::Stages& s) { s.transportDust(kStep); });
    expectSame(Field::Faces, kRounding);
    expectSame(Field::Density, 1e-5);
    const std::vector<float> density = gl(Field::Density);
    EXPECT_GE(*std::min_element(density.begin(), density.end()), 0);
  }
}

}  // namespace
}  // namespace rubble::test
