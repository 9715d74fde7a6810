// The whole step on both back ends.
#include "gl/dust/both.h"

namespace rubble::test {
namespace {

using dust::Field;

class DustStep : public Both {
 protected:
  // A burst, then a body that falls through the cloud.
  static std::vector<DustSource> sources(int step) {
    if (step >= 10) return {};
    std::vector<DustSource> list;
    for (int i = 0; i < 20; ++i) {
      const float a = 0.7f * float(i + step);
      list.push_back({{0.5f * std::cos(a), 0.3f + 0.05f * float(i), 0.5f * std::sin(a)},
                      {2 * std::cos(a), 1, 2 * std::sin(a)},
                      0.01f,
                      1e-5f});
    }
    list.push_back({{50, 0, 0}, {0, 0, 0}, 0.02f, 1e-5f});  // outside: has left at once
    return list;
  }
  static std::vector<DustObstacle> obstacles(int step) {
    if (step < 5 || step >= 25) return {};
    DustObstacle body;
    body.kind = DustObstacle::Kind::Box;
    body.halfExtents = {0.5f, 0.3f, 0.4f};
    body.velocity = {0, -3, 0};
    body.position = {0.2f, 1.8f - 3 * kStep * float(step - 5), 0.1f};
    return {body};
  }
  void run(DustGrid& grid, int from, int to) {
    for (int i = from; i < to; ++i) grid.step(kStep, sources(i), obstacles(i));
  }
};

// Both are the same flow, in which 30 steps of a burst let differences of rounding grow. Measured on
// llvmpipe: 6e-8 in the mean and 2e-5 in the worst cell (kg/m^3 or m/s); another GPU rounds otherwise, so the
// mean, in which a mistake would show, is held to 1e-6 of the largest value and any one cell to 1e-3.
TEST_F(DustStep, ThirtyStepsEndInTheSameCloud) {
  make(grid());
  run(*m_cpu, 0, 30);
  run(*m_gl, 0, 30);
  for (Field f : {Field::Density, Field::Velocity}) {
    const Difference d = compare(f);
    EXPECT_GT(d.scale, 0.01);
    EXPECT_LE(d.mean, 1e-6 * d.scale);
    EXPECT_LE(d.most, 1e-3 * d.scale);
    RecordProperty(f == Field::Density ? "density" : "velocity", std::to_string(d.most / d.scale));
  }
}

// A finer grid has several work groups a row, a coarser one less than a whole chunk of sums.
TEST_F(DustStep, IsTheSameOnGridsOfOtherSizes) {
  for (int resolution : {8, 64}) {
    make(grid(resolution));
    run(*m_cpu, 4, 7);
    run(*m_gl, 4, 7);
    expectSame(Field::Density, 1e-4);
    expectSame(Field::Velocity, 1e-4);
  }
}

// Dust is only moved: what was emitted is in the air, has settled or has left. Rounding: 60 steps of a few
// operations a cell, each 6e-8 of that cell, of either sign. Measured: 2e-7 at 8^3, 1e-8 at 32^3.
TEST_F(DustStep, KeepsTheMassOfTheDust) {
#ifdef RUBBLE_SANITIZED  // the same code on every grid
  const std::vector<int> resolutions = {8, 16};
#else
  const std::vector<int> resolutions = {8, 16, 32};
#endif
  for (const int resolution : resolutions) {
    make(grid(resolution));
    run(*m_gl, 0, 60);
    gl(Field::Density);     // waits, so that the sums of the 60 steps are there
    m_gl->step(0, {}, {});  // and are taken
    const DustTotals t = m_gl->totals();
    EXPECT_NEAR(t.emitted, 10 * (20 * 0.01 + 0.02), 1e-6);
    EXPECT_GT(t.air, 0);
    EXPECT_GT(t.settled, 0);
    EXPECT_GE(t.left, 0.2 - 1e-6);
    EXPECT_LT(t.error(), 2e-6);
  }
}

TEST_F(DustStep, TotalsArriveAStepLateAndAreThoseOfTheCpu) {
  make(grid());
  EXPECT_EQ(m_gl->totals().emitted, 0);
  run(*m_cpu, 0, 30);
  run(*m_gl, 0, 30);
  gl(Field::Density);
  EXPECT_LT(m_gl->totals().emitted + m_gl->totals().air, 2 * m_cpu->totals().emitted);
  run(*m_gl, 30, 31);
  const DustTotals a = m_cpu->totals(), b = m_gl->totals();
  EXPECT_EQ(a.emitted, b.emitted);
  // The clouds differ by rounding, grown over 30 steps, mostly within the grid.
  EXPECT_NEAR(a.air, b.air, 1e-5 * a.emitted);
  EXPECT_NEAR(a.settled, b.settled, 1e-5 * a.emitted);
  EXPECT_NEAR(a.left, b.left, 1e-5 * a.emitted);
}

TEST_F(DustStep, IsTheSameToTheLastBitOnEveryRun) {
#ifdef RUBBLE_SANITIZED
  constexpr int kFrames = 5;
#else
  constexpr int kFrames = 20;
#endif
  make(grid());
  run(*m_gl, 0, kFrames);
  const std::vector<float> density = gl(Field::Density), velocity = gl(Field::Velocity);
  make(grid());
  run(*m_gl, 0, kFrames);
  EXPECT_EQ(density, gl(Field::Density));
  EXPECT_EQ(velocity, gl(Field::Velocity));
}

TEST_F(DustStep, HostileInputStaysFinite) {
  make(grid(8));
  const float nan = std::nanf(""), huge = 3e38f;
  const std::vector<DustSource> bad = {{{0, 1, 0}, {huge, huge, -huge}, 1, 1e-5f},
                                       {{0, 1, 0}, {nan, 0, 0}, 1, 1e-5f},
                                       {{nan, 1, 0}, {0, 0, 0}, 1, 1e-5f},
                                       {{1, 1, 0}, {0, 0, 0}, 1e6f, 1e-5f}};
  std::vector<DustObstacle> bodies(2);
  bodies[0].spin = {huge, -huge, huge};
  bodies[0].position = {0, 1, 0};
  bodies[1].position = {nan, 0, 0};
  for (float dt : {kStep, nan, -1.0f, huge, kStep}) m_gl->step(dt, bad, bodies);
  for (Field f : {Field::Density, Field::Velocity}) {
    const std::vector<float> values = gl(f);
    EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }));
  }
}

TEST_F(DustStep, OffersItsDensityToTheRenderer) {
  make(grid(8));
  EXPECT_STREQ(m_gl->backend(), "gl");
  EXPECT_TRUE(glIsBuffer(m_gl->densityBuffer()));
  const GLuint before = m_gl->densityBuffer();
  run(*m_gl, 0, 3);
  EXPECT_EQ(before, m_gl->densityBuffer());
  EXPECT_EQ(m_cpu->densityBuffer(), 0u);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace rubble::test
