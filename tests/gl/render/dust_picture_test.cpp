#include <epoxy/gl.h>

#include "gl/render/picture.h"

namespace rubble::test {
namespace {

// A grid whose density the test sets, [kg/m^3].
class GivenDust : public DustGrid {
 public:
  explicit GivenDust(const DustGridDef& def) : DustGrid(def), density(cellCount(), 0) {}
  void step(float, std::span<const DustSource>, std::span<const DustObstacle>) override {}
  DustTotals totals() const override { return {}; }
  void readDensity(std::vector<float>& out) const override { out = density; }
  void readVelocity(std::vector<Eigen::Vector3f>& out) const override {
    out.assign(cellCount(), Eigen::Vector3f::Zero());
  }
  const char* backend() const override { return buffer == 0 ? "cpu" : "gl"; }
  std::uint32_t densityBuffer() const override { return buffer; }

  std::vector<float> density;
  std::uint32_t buffer = 0;
};

constexpr int kCells = 32;
const float kExtinction = massExtinction(2400, 1e-6f);  // of the default grain [m^2/kg]

class DustPicture : public Picture {
 protected:
  // A box of 4 x 1 x 4 metres in a constant white light that the dust does not scatter.
  DustPicture() : m_dust({.resolution = kCells, .min = {-2, 1, -2}, .max = {2, 2, 2}}) {}

  void prepare() override {
    Picture::prepare();
    m_lighting.skyZenith = m_lighting.skyHorizon = {2, 2, 2};
    m_lighting.exposure = 0.4f;
    m_black.colour.setZero();
  }
  void fill(float opticalDepthOfOneMetre) {
    std::fill(m_dust.density.begin(), m_dust.density.end(), opticalDepthOfOneMetre / kExtinction);
  }
  double centre(const Image& image) const { return light(image, kWidth / 2, kHeight / 2); }

  GivenDust m_dust;
  DustLook m_black;
};

TEST_F(DustPicture, SlabLetsThroughExpOfMinusItsOpticalDepth) {
  m_camera.eye = {0, 6, 0};
  m_camera.target = {0, -1, 0};
  m_camera.up = {0, 0, 1};
  m_camera.verticalFov = 0.3f;
  const double clear = centre(draw());
  m_renderer->setDust(&m_dust, m_black);
  for (const float depth : {0.1f, 0.5f, 1.f, 2.f}) {
    fill(depth);
    // Bouguer's law. 64 steps see a uniform slab exactly; what remains is the 8-bit picture.
    EXPECT_NEAR(centre(draw()) / clear, std::exp(-double(depth)), 0.02) << "optical depth " << depth;
  }
}

TEST_F(DustPicture, OpacityScalesTheOpticalDepth) {
  m_camera.eye = {0, 6, 0};
  m_camera.target = {0, -1, 0};
  m_camera.up = {0, 0, 1};
  const double clear = centre(draw());
  fill(2);
  m_black.opacity = 0.25f;
  m_renderer->setDust(&m_dust, m_black);
  EXPECT_NEAR(centre(draw()) / clear, std::exp(-0.5), 0.02);
}

TEST_F(DustPicture, RayEndsAtTheSolidItMeets) {
  // A sheet in the middle of the slab, glossless and lit evenly: seen through half of the dust.
  m_camera.eye = {0, 6, 0};
  m_camera.target = {0, -1, 0};
  m_camera.up = {0, 0, 1};
  m_camera.verticalFov = 0.3f;
  m_lighting.sunColour.setZero();
  m_lighting.skyAmbient = m_lighting.groundAmbient = {2, 2, 2};
  const PropId sheet = m_renderer->addBox({1.5f, 0.01f, 1.5f}, {.colour = {0.8f, 0.8f, 0.8f}, .gloss = 0});
  m_renderer->setPropPose(sheet, {0, 1.49f, 0}, Eigen::Quaternionf::Identity());
  const double clear = centre(draw());
  fill(1);
  m_renderer->setDust(&m_dust, m_black);
  EXPECT_NEAR(centre(draw()) / clear, std::exp(-0.5), 0.02);
}

TEST_F(DustPicture, DustBehindASolidDoesNotTouchIt) {
  // Sun and camera on the same side, the dust behind the box: neither its light nor its picture passes the
  // dust.
  m_camera.eye = {0, 1.5f, 6};
  m_camera.target = {0, 1.5f, 0};
  m_lighting.sunDirection = {0, 0.3f, 1};
  m_lighting.exposure = 0.2f;
  const PropId box = m_renderer->addBox({0.6f, 0.6f, 0.6f}, {.colour = {0.5f, 0.1f, 0.1f}, .gloss = 0});
  m_renderer->setPropPose(box, {0, 1.5f, 3}, Eigen::Quaternionf::Identity());
  const Image clear = draw();
  fill(3);
  m_renderer->setDust(&m_dust);
  const Image dusty = draw();
  std::size_t boxPixels = 0, touched = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (at(clear, x, y, 0) < 2 * at(clear, x, y, 1)) continue;  // not the red box, or a pixel of its rim
      ++boxPixels;
      for (int channel = 0; channel < 3; ++channel) {
        if (std::abs(at(clear, x, y, channel) - at(dusty, x, y, channel)) > 1) {
          ++touched;
          break;
        }
      }
    }
  }
  EXPECT_GT(boxPixels, 2000u);
  EXPECT_EQ(touched, 0u);
  EXPECT_GT(differentPixels(clear, dusty), 5000u);  // and the dust is there
}

TEST_F(DustPicture, SunThroughASlabIsWeakenedAlongItsSlant) {
  m_camera.eye = {0, 0.6f, 1};  // below the slab
  m_camera.target = {0, 0, 0};
  m_lighting.skyAmbient.setZero();
  m_renderer->addGroundPlane(0, {0.6f, 0.6f, 0.6f});
  for (const Eigen::Vector3f& sun : {Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0.5f, 0.8f, 0.3f)}) {
    m_lighting.sunDirection = sun;
    m_renderer->setDust(nullptr);
    const double clear = centre(draw());
    fill(0.6f);
    m_renderer->setDust(&m_dust, m_black);
    const double slant = 1 / double(sun.normalized().y());  // metres of dust on the way
    // Half a slice is lost at the end of the light volume: 1/64 of the optical depth.
    EXPECT_NEAR(centre(draw()) / clear, std::exp(-0.6 * slant), 0.03);
  }
}

TEST_F(DustPicture, BothBackEndsLookTheSame) {
  m_camera.eye = {0, 3, 6};
  m_camera.target = {0, 1.5f, 0};
  Random random(5);
  for (float& density : m_dust.density) density = 2 * random.unit() / kExtinction;
  m_renderer->setDust(&m_dust);
  const Image cpu = draw();
  glGenBuffers(1, &m_dust.buffer);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, m_dust.buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(m_dust.density.size() * sizeof(float)),
               m_dust.density.data(), GL_STATIC_DRAW);
  const Image gl = draw();
  EXPECT_EQ(cpu.pixels, gl.pixels);
  m_renderer->setDust(nullptr);
  EXPECT_GT(differentPixels(cpu, draw()), 1000u);
  glDeleteBuffers(1, &m_dust.buffer);
}

TEST_F(DustPicture, EmptyGridChangesNothing) {
  m_renderer->addGroundPlane(0);
  const Image clear = draw();
  m_renderer->setDust(&m_dust);
  EXPECT_EQ(draw().pixels, clear.pixels);
}

}  // namespace
}  // namespace rubble::test
