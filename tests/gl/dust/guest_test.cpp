// The compute back end as a guest in an application's context.
#include <epoxy/gl.h>

#include "gl/hostile.h"
#include "rubble/dust.h"
#include "support/folders.h"

namespace rubble::test {
namespace {

constexpr float kFrame = 1.0f / 60;  // [s]

struct Fields {
  std::vector<float> density;
  std::vector<Eigen::Vector3f> velocity;
};

void nothing() {}

std::unique_ptr<DustGrid> makeGrid() {
  return createDustGridGl({.resolution = 8, .min = {-1, 0, -1}, .max = {1, 2, 1}}, test::shaderFolder());
}

// More sources in each step: their list asks for storage again.
void step(DustGrid& grid, int number) {
  std::vector<DustSource> sources;
  for (int i = 0; i <= 3 * number; ++i)
    sources.push_back({{-0.9f + 0.17f * float(i), 0.4f, 0.1f}, {0, 3, 1}, 0.01f, 1e-5f});
  DustObstacle ball;
  ball.position = {0, 1, 0};
  ball.velocity = {2, 0, 0};
  grid.step(kFrame, sources, std::vector{ball});
}

Fields fieldsUnder(void (*disturb)()) {
  OwnContext context;
  disturb();
  const std::unique_ptr<DustGrid> grid = makeGrid();
  Fields fields;
  for (int i = 0; i < 3; ++i) {
    disturb();
    step(*grid, i);
  }
  disturb();
  grid->readDensity(fields.density);
  disturb();
  grid->readVelocity(fields.velocity);
  return fields;
}

class DustUnder : public GlTest, public ::testing::WithParamInterface<Hostility> {};

TEST_P(DustUnder, IsThatOfACleanState) {
  const Fields clean = fieldsUnder(nothing), hostile = fieldsUnder(GetParam().set);
  EXPECT_EQ(clean.density, hostile.density);
  EXPECT_TRUE(clean.velocity == hostile.velocity);
}

// What kernels and buffers could feel; the last is every kind at once.
INSTANTIATE_TEST_SUITE_P(Hostile, DustUnder,
                         ::testing::Values(hostility("Unpack"), hostility("PixelBuffers"),
                                           hostility("Buffers"), hostility("Program"), hostility("Discard"),
                                           hostility("Errors"), hostility("ConditionalRender"),
                                           hostility("Feedback"), hostility("All")),
                         [](const auto& kind) { return kind.param.name; });

class DustGuest : public GlTest {};

TEST_F(DustGuest, FindsEveryStateAgain) {
  OwnContext context;
  const auto expectKept = [](const char* call, auto&& work) {
    hostility("All").set();
    const auto before = stateOfContext();
    work();
    EXPECT_EQ(before, stateOfContext()) << call;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << call;
  };
  std::unique_ptr<DustGrid> grid;
  std::vector<float> density;
  expectKept("createDustGridGl", [&] { grid = makeGrid(); });
  expectKept("step", [&] { step(*grid, 1); });
  expectKept("step of a longer list", [&] { step(*grid, 5); });
  expectKept("readDensity", [&] { grid->readDensity(density); });
  expectKept("a refused grid", [&] { EXPECT_THROW(createDustGridGl({}, "nowhere"), Error); });
}

}  // namespace
}  // namespace rubble::test
