// The renderer as a guest in an application's context: its pictures depend on no state of the application's,
// and that state is found again.
#include <epoxy/gl.h>

#include <array>

#include "gl/hostile.h"
#include "gl/render/guarded_new.h"
#include "gl/render/picture.h"

namespace rubble::test {
namespace {

constexpr int kWide = 97, kHigh = 61;  // odd: no alignment of rows fits by chance

// All that a picture can hold: a body with a gap, debris, a prop, the floor, dust.
class SmallScene {
 public:
  explicit SmallScene(void (*disturb)())
      : m_dust(createDustGridCpu({.resolution = 8, .min = {-1, 0, -1}, .max = {2, 2, 2}})) {
    disturb();
    m_renderer = std::make_unique<Renderer>(
        RendererDef{.shaderDirectory = test::shaderFolder(), .shadowMapSize = 256, .dustSteps = 8});
    disturb();
    m_framebuffer = std::make_unique<Framebuffer>(kWide, kHigh);
    disturb();
    const BodyId body = m_renderer->addBody(m_asset);
    disturb();
    m_renderer->addSphere(0.3f);
    m_renderer->addGroundPlane(0);
    std::vector<ElementPose> poses = restPoses(m_asset);
    std::vector<std::uint8_t> springs(m_asset.springs.size(), 0);
    poses[7].position += Eigen::Vector3f(0.1f, 0.2f, 0.1f);
    disturb();
    m_renderer->updateBody(body, poses, springs);
    const Eigen::Quaternionf turn(Eigen::AngleAxisf(0.5f, Eigen::Vector3f::UnitY()));
    m_renderer->setDebris(std::vector<DebrisInstance>{{{0.2f, 0.3f, 1.4f}, 0.5f, turn, body, 3}});
    m_dust->step(0.02f, std::vector<DustSource>{{{0.9f, 0.5f, 0.9f}, {0, 1, 0}, 1e-4f, 1e-5f}}, {});
    m_renderer->setDust(m_dust.get());
  }

  Image draw(void (*disturb)()) {
    const Camera camera{.eye = {2.5f, 2.2f, 3.5f}, .target = {0.5f, 0.5f, 0.5f}};
    disturb();
    m_renderer->draw(camera, {}, m_framebuffer->target());
    disturb();
    return m_framebuffer->readPixels();
  }
  Renderer& renderer() { return *m_renderer; }
  FrameTarget target() const { return m_framebuffer->target(); }

 private:
  Asset m_asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.5});
  std::unique_ptr<DustGrid> m_dust;
  std::unique_ptr<Renderer> m_renderer;
  std::unique_ptr<Framebuffer> m_framebuffer;
};

void nothing() {}

Image pictureUnder(void (*disturb)()) {
  OwnContext context;
  SmallScene scene(disturb);
  return scene.draw(disturb);
}

class PictureUnder : public GlTest, public ::testing::WithParamInterface<Hostility> {};

std::string nameOf(const ::testing::TestParamInfo<Hostility>& kind) {
  return kind.param.name;
}

TEST_P(PictureUnder, IsThatOfACleanState) {
  const Image clean = pictureUnder(nothing);
  const Image hostile = pictureUnder(GetParam().set);
  EXPECT_TRUE(clean.pixels == hostile.pixels);
}

INSTANTIATE_TEST_SUITE_P(Hostile, PictureUnder,
                         ::testing::ValuesIn(hostilities().begin(), hostilities().end()), nameOf);

class GuestInContext : public GlTest {};

// The noise of the surfaces is the only texture that is filled from memory; it is made in the constructor.
TEST_F(GuestInContext, NoiseMadeUnderHostileUnpackingIsThatOfACleanState) {
  const Image clean = pictureUnder(nothing);
  OwnContext context;
  hostility("Unpack").set();
  hostility("PixelBuffers").set();
  SmallScene scene(nothing);
  EXPECT_TRUE(clean.pixels == scene.draw(nothing).pixels);
}

TEST_F(GuestInContext, ReadPixelsStaysWithinItsImage) {
  OwnContext context;
  SmallScene scene(nothing);
  const std::size_t before = overrunBlocks();
  {
    const Image clean = scene.draw(nothing);
    const Image shifted = scene.draw(hostility("PackSkip").set);
    EXPECT_TRUE(clean.pixels == shifted.pixels);
    EXPECT_EQ(clean.pixels.size(), std::size_t{4} * kWide * kHigh);
  }
  EXPECT_EQ(overrunBlocks(), before);
}

TEST_F(GuestInContext, FindsEveryStateAgain) {
  OwnContext context;
  const auto expectKept = [](const char* call, auto&& work) {
    hostility("All").set();
    const auto before = stateOfContext();
    work();
    EXPECT_EQ(before, stateOfContext()) << call;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << call;
  };
  const Asset asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.5});
  const std::vector<std::uint8_t> springs(asset.springs.size(), 0);
  std::unique_ptr<SmallScene> scene;
  BodyId body{};
  expectKept("making a scene", [&] { scene = std::make_unique<SmallScene>(nothing); });
  expectKept("addBody", [&] { body = scene->renderer().addBody(asset); });
  expectKept("updateBody", [&] { scene->renderer().updateBody(body, restPoses(asset), springs); });
  expectKept("addBox", [&] { scene->renderer().addBox({1, 1, 1}); });
  expectKept("draw and readPixels", [&] { scene->draw(nothing); });
  expectKept("a refused draw",
             [&] { EXPECT_THROW(scene->renderer().draw({.verticalFov = -1}, {}, scene->target()), Error); });
  expectKept("a refused renderer", [&] { EXPECT_THROW(Renderer({.shaderDirectory = "nowhere"}), Error); });
}

TEST_F(GuestInContext, ErrorsOfItsOwnAreThrown) {
  OwnContext context;
  SmallScene scene(nothing);
  GLuint empty = 0;
  glGenFramebuffers(1, &empty);
  glBindFramebuffer(GL_FRAMEBUFFER, empty);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  EXPECT_THROW(scene.renderer().draw({}, {}, {empty, kWide, kHigh}), Error);  // nothing to draw into
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  EXPECT_NO_THROW(scene.draw(nothing));
}

TEST_F(GuestInContext, LeavesNoErrorInTheDebugLog) {
  OwnContext context;
  int errors = 0;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(
      [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* count) {
        if (type != GL_DEBUG_TYPE_ERROR) return;
        ADD_FAILURE() << text;
        ++*static_cast<int*>(const_cast<void*>(count));
      },
      &errors);
  SmallScene scene(nothing);
  scene.draw(nothing);
  EXPECT_EQ(errors, 0);
  EXPECT_EQ(glIsEnabled(GL_DEBUG_OUTPUT), GL_TRUE);
}

// A target with a second draw buffer, as deferred renderers have: it is the application's.
TEST_F(GuestInContext, DrawsIntoTheFirstDrawBufferAlone) {
  OwnContext context;
  SmallScene scene(nothing);
  std::array<GLuint, 2> textures{};
  GLuint framebuffer = 0;
  glGenTextures(2, textures.data());
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  for (GLuint i = 0; i < 2; ++i) {
    glBindTexture(GL_TEXTURE_2D, textures[i]);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, kWide, kHigh);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i, GL_TEXTURE_2D, textures[i], 0);
  }
  const std::array<GLenum, 2> buffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, buffers.data());
  glClearColor(0.2f, 0.4f, 0.6f, 0.8f);
  glClear(GL_COLOR_BUFFER_BIT);
  scene.renderer().draw({}, {}, {framebuffer, kWide, kHigh});
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  std::array<std::uint8_t, 4> pixel{};
  glReadPixels(kWide / 2, kHigh / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  EXPECT_EQ(pixel, (std::array<std::uint8_t, 4>{51, 102, 153, 204}));
}

}  // namespace
}  // namespace rubble::test
