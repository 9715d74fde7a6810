// The frame: shadow map, light in the dust, solids, sky, dust, tone curve.
#include <cmath>
#include <map>
#include <string>

#include "base/stopwatch.h"
#include "gl/bindings.h"
#include "gl/capabilities.h"
#include "gl/error.h"
#include "gl/guest.h"
#include "gl/raster.h"
#include "gl/shader.h"
#include "render/cell_body.h"
#include "render/debris_batch.h"
#include "render/dust_volume.h"
#include "render/frame.h"
#include "render/noise_texture.h"
#include "render/prop.h"
#include "render/targets.h"
#include "rubble/limits.h"
#include "rubble/render.h"

namespace rubble {
namespace {

using namespace render;

constexpr int kSphereLevels = 4;          // 5120 triangles
constexpr float kShadowSlopeBias = 1.5f;  // glPolygonOffset, factor and units
constexpr float kShadowUnitBias = 2;
// Unless the caller says otherwise, what flies off the bodies casts shadows within this many of their
// diagonals.
constexpr float kShadowRoom = 1;
constexpr float kBareShadowRoom = 2;  // the same in a scene without bodies [m]
static_assert(RUBBLE_DUST_DEPTH_UNIT < gl::kGuestUnits &&
                  RUBBLE_DUST_BOUNDS_BUFFER < gl::kGuestStorageBuffers &&
                  RUBBLE_FRAME_BLOCK < gl::kGuestUniformBuffers && RUBBLE_DUST_LIGHT_IMAGE < gl::kGuestImages,
              "what the shaders bind is given back to the caller");
constexpr const char* kShadowPass = "#define RUBBLE_SHADOW_PASS\n";

const RendererDef& checked(const RendererDef& def) {
  GLint blocks = 0, most = 1;
  glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks < 4)
    throw Error("Renderer: needs 4 storage buffers in vertex shaders, the driver has " +
                std::to_string(blocks));
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const bool power = def.samples == 1 || def.samples == 2 || def.samples == 4 || def.samples == 8;
  if (!power)
    throw Error("RendererDef::samples: " + std::to_string(def.samples) + ", allowed are 1, 2, 4 and 8");
  if (def.samples > most) {
    throw Error("RendererDef::samples: " + std::to_string(def.samples) + ", the driver has at most " +
                std::to_string(most));
  }
  if (def.shadowMapSize < 256 || def.shadowMapSize > 8192) {
    throw Error("RendererDef::shadowMapSize: " + std::to_string(def.shadowMapSize) +
                ", allowed are 256 to 8192");
  }
  if (def.dustSteps < 8 || def.dustSteps > 512) {
    throw Error("RendererDef::dustSteps: " + std::to_string(def.dustSteps) + ", allowed are 8 to 512");
  }
  return def;
}

gl::ProgramName solidProgram(const std::string& shaders, const char* vertexFile) {
  return gl::makeProgram(shaders, {{GL_VERTEX_SHADER, vertexFile}, {GL_FRAGMENT_SHADER, "draw/solid.frag"}});
}
gl::ProgramName shadowProgram(const std::string& shaders, const char* vertexFile) {
  return gl::makeProgram(shaders, {{GL_VERTEX_SHADER, vertexFile, kShadowPass}});
}
gl::ProgramName fullscreenProgram(const std::string& shaders, const char* fragmentFile,
                                  const char* defines = "") {
  return gl::makeProgram(
      shaders, {{GL_VERTEX_SHADER, "draw/fullscreen.vert"}, {GL_FRAGMENT_SHADER, fragmentFile, defines}});
}

void bindTexture(GLuint unit, GLenum target, GLuint texture) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(target, texture);
}

void setColour(GLint uniform, const Eigen::Vector3f& colour, float w) {
  glUniform4f(uniform, colour.x(), colour.y(), colour.z(), w);
}

}  // namespace

double PassTimes::total() const {
  return upload + shadow + dustVolume + cells + debris + props + sky + resolve + dust + composite;
}

struct Renderer::Impl {
  struct Body {
    CellBody cells;
    DebrisBatch debris;
    bool removed = false;  // kept for its debris alone
    Body(const Asset& asset, CellJoining joining, const CellColours& colours)
        : cells(asset, joining, colours), debris(cells) {}
  };
  struct Ground {
    float height;
    Eigen::Vector3f colour;
  };

  explicit Impl(const RendererDef& rendererDef) : Impl(rendererDef, gl::capabilitiesNow("Renderer")) {}
  Impl(const RendererDef& rendererDef, const gl::Capabilities& current)
      : Impl(rendererDef, current, gl::Guest(current)) {}
  Impl(const RendererDef& rendererDef, const gl::Capabilities& current, const gl::Guest&)
      : capabilities(current),
        def(checked(rendererDef)),
        cellProgram(solidProgram(def.shaderDirectory, "draw/cells.vert")),
        debrisProgram(solidProgram(def.shaderDirectory, "draw/debris.vert")),
        propProgram(solidProgram(def.shaderDirectory, "draw/prop.vert")),
        cellShadow(shadowProgram(def.shaderDirectory, "draw/cells.vert")),
        debrisShadow(shadowProgram(def.shaderDirectory, "draw/debris.vert")),
        propShadow(shadowProgram(def.shaderDirectory, "draw/prop.vert")),
        groundProgram(gl::makeProgram(def.shaderDirectory, {{GL_VERTEX_SHADER, "draw/ground.vert"},
                                                            {GL_FRAGMENT_SHADER, "draw/ground.frag"}})),
        skyProgram(fullscreenProgram(def.shaderDirectory, "draw/sky.frag")),
        dustProgram(fullscreenProgram(def.shaderDirectory, "draw/dust_march.frag")),
        compositeProgram(fullscreenProgram(def.shaderDirectory, "draw/composite.frag")),
        compositeDust(fullscreenProgram(def.shaderDirectory, "draw/composite.frag", "#define RUBBLE_DUST\n")),
        noise(makeNoiseTexture()),
        noVertices(gl::makeVertexArray()),
        shadowMap(def.shadowMapSize),
        scene(def.samples),
        dustVolume(def.shaderDirectory) {}

  Body& body(BodyId id, const char* caller) {
    const auto it = bodies.find(id);
    if (it == bodies.end() || it->second.removed) {
      throw Error(std::string(caller) + ": there is no body " + std::to_string(std::uint32_t(id)));
    }
    return it->second;
  }
  PropId addProp(const Shape& shape, const PropLook& look) {
    const gl::Guest guest(capabilities);
    const PropId id{nextId++};
    props.try_emplace(id, shape, look);
    return id;
  }

  template <class Work>
  void timed(double& milliseconds, const Work& work) const {
    if (!def.measurePasses) return work();
    glFinish();
    base::Stopwatch watch;
    work();
    glFinish();
    milliseconds += watch.lap();
  }

  void checkPiece(const DebrisInstance& piece) const;
  void forgetRemoved();
  Eigen::AlignedBox3f shadowBounds() const;

  // Stages of draw(), in order.
  void upload(const Camera& camera, const Lighting& lighting, const FrameTarget& target);
  void drawShadows();
  void lightDust();
  void drawCells();
  void drawDebris();
  void drawProps();
  void drawGroundAndSky();
  void marchDust();
  void composite(const FrameTarget& target);
  void setSolidState();

  gl::Capabilities capabilities;
  RendererDef def;
  gl::ProgramName cellProgram, debrisProgram, propProgram, cellShadow, debrisShadow, propShadow,
      groundProgram, skyProgram, dustProgram, compositeProgram, compositeDust;
  gl::TextureName noise;
  gl::VertexArrayName noVertices;
  ShadowMap shadowMap;
  SceneTargets scene;
  DustVolume dustVolume;
  gl::Buffer frameBuffer;

  std::map<BodyId, Body> bodies;
  std::map<PropId, Prop> props;
  std::uint32_t nextId = 0;
  std::optional<Ground> ground;
  const DustGrid* grid = nullptr;
  DustLook dustLook;
  bool hasDust = false;  // in this frame
  PassTimes times;
  DrawCounts counts;
};

void Renderer::Impl::checkPiece(const DebrisInstance& piece) const {
  const auto it = bodies.find(piece.body);
  const bool isForgotten = it == bodies.end() && std::uint32_t(piece.body) < nextId &&
                           !props.contains(PropId{std::uint32_t(piece.body)});
  if (isForgotten) return;
  if (it == bodies.end()) {
    throw Error("Renderer::setDebris: there is no body " + std::to_string(std::uint32_t(piece.body)));
  }
  if (piece.element >= it->second.cells.elementCount()) {
    throw Error("Renderer::setDebris: there is no element " + std::to_string(piece.element));
  }
  if (!piece.position.allFinite() || !std::isfinite(piece.scale) || !piece.orientation.coeffs().allFinite()) {
    throw Error("Renderer::setDebris: a piece of element " + std::to_string(piece.element) +
                " is not finite");
  }
}

// Not earlier than in draw(): debris of the tick in which a body was removed are handed over after that.
void Renderer::Impl::forgetRemoved() {
  std::erase_if(bodies,
                [](const auto& entry) { return entry.second.removed && entry.second.debris.empty(); });
}

Eigen::AlignedBox3f Renderer::Impl::shadowBounds() const {
  Eigen::AlignedBox3f box;
  for (const auto& [id, body] : bodies) box.extend(body.cells.firstBounds());
  const bool bare = box.isEmpty();
  if (bare) box.extend(Eigen::Vector3f(0, 0, 0));
  const float room = bare ? kBareShadowRoom : kShadowRoom * box.diagonal().norm();
  return {box.min() - Eigen::Vector3f::Constant(room), box.max() + Eigen::Vector3f::Constant(room)};
}

void Renderer::Impl::upload(const Camera& camera, const Lighting& lighting, const FrameTarget& target) {
  const Eigen::AlignedBox3f casters = lighting.shadowBounds.value_or(shadowBounds());
  shared::Frame frame = makeFrame({&camera, &lighting, target, casters, def.shadowMapSize});
  scene.resize(target.width, target.height);
  const PieceView view{camera.eye, float(target.height) / (2 * std::tan(camera.verticalFov / 2))};
  counts = {};
  for (auto& [id, body] : bodies) {
    body.debris.prepare(body.cells, view);
    if (!body.removed) counts.cellTriangles += body.cells.visibleTriangles();
    counts.debrisTriangles += body.debris.triangles();
    counts.debrisPieces += body.debris.drawn();
    counts.debrisTooSmall += body.debris.tooSmall();
  }
  hasDust = grid != nullptr && dustVolume.update(*grid, dustLook);
  if (hasDust) dustVolume.describe(*grid, dustLook, def.dustSteps, frame);
  frameBuffer.upload(std::as_bytes(std::span(&frame, 1)), GL_STREAM_DRAW);
  frameBuffer.bindBase(GL_UNIFORM_BUFFER, RUBBLE_FRAME_BLOCK);
}

// Beside the defaults that gl::Guest has set.
void Renderer::Impl::setSolidState() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
}

void Renderer::Impl::drawShadows() {
  shadowMap.begin();
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(kShadowSlopeBias, kShadowUnitBias);
  glEnable(GL_DEPTH_CLAMP);  // what is nearer to the sun than the map still casts
  glUseProgram(cellShadow.id());
  for (const auto& [id, body] : bodies)
    if (!body.removed) body.cells.draw();
  glUseProgram(debrisShadow.id());
  for (const auto& [id, body] : bodies) body.debris.draw(body.cells);
  glUseProgram(propShadow.id());
  for (const auto& [id, prop] : props) prop.draw();
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_POLYGON_OFFSET_FILL);
  bindTexture(RUBBLE_SHADOW_UNIT, GL_TEXTURE_2D, shadowMap.texture());
  bindTexture(RUBBLE_NOISE_UNIT, GL_TEXTURE_3D, noise.id());
}

void Renderer::Impl::lightDust() {
  if (hasDust) dustVolume.light();
}

void Renderer::Impl::drawCells() {
  scene.beginScene();
  glUseProgram(cellProgram.id());
  for (const auto& [id, body] : bodies) {
    if (body.removed) continue;
    setColour(RUBBLE_OUTER_UNIFORM, body.cells.colours().outer, 0);
    setColour(RUBBLE_INNER_UNIFORM, body.cells.colours().inner, 0);
    body.cells.draw();
  }
}

void Renderer::Impl::drawDebris() {
  glUseProgram(debrisProgram.id());
  for (const auto& [id, body] : bodies) {
    setColour(RUBBLE_OUTER_UNIFORM, body.cells.colours().outer, 0);
    setColour(RUBBLE_INNER_UNIFORM, body.cells.colours().inner, 0);
    body.debris.draw(body.cells);
  }
}

void Renderer::Impl::drawProps() {
  glUseProgram(propProgram.id());
  for (const auto& [id, prop] : props) {
    setColour(RUBBLE_OUTER_UNIFORM, prop.look().colour, prop.look().gloss);
    setColour(RUBBLE_INNER_UNIFORM, prop.look().colour, 0);
    prop.draw();
  }
}

void Renderer::Impl::drawGroundAndSky() {
  glBindVertexArray(noVertices.id());
  if (ground) {
    glUseProgram(groundProgram.id());
    setColour(RUBBLE_GROUND_UNIFORM, ground->colour, ground->height);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glUseProgram(skyProgram.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::Impl::marchDust() {
  glDisable(GL_DEPTH_TEST);
  bindTexture(RUBBLE_DEPTH_UNIT, GL_TEXTURE_2D, scene.depth());
  if (!hasDust) return;
  scene.beginDust();
  glUseProgram(dustProgram.id());
  dustVolume.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::Impl::composite(const FrameTarget& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl::setViewport(target.width, target.height);
  // The target may have a second draw buffer, which composite.frag would fill with anything.
  glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  bindTexture(RUBBLE_COLOUR_UNIT, GL_TEXTURE_2D, scene.colour());
  bindTexture(RUBBLE_DUST_UNIT, GL_TEXTURE_2D, scene.dust());
  bindTexture(RUBBLE_DUST_DEPTH_UNIT, GL_TEXTURE_2D, scene.dustDistance());
  glUseProgram((hasDust ? compositeDust : compositeProgram).id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Renderer::Renderer(const RendererDef& def) : m_impl(std::make_unique<Impl>(def)) {}
Renderer::~Renderer() = default;

BodyId Renderer::addBody(const Asset& asset, CellJoining joining, const CellColours& colours) {
  asset.validate();
  const gl::Guest guest(m_impl->capabilities);
  const BodyId id{m_impl->nextId++};
  m_impl->bodies.try_emplace(id, asset, joining, colours);
  return id;
}

void Renderer::removeBody(BodyId id) {
  m_impl->body(id, "Renderer::removeBody").removed = true;
}

void Renderer::updateBody(BodyId id, std::span<const ElementPose> poses,
                          std::span<const std::uint8_t> springsIntact) {
  const gl::Guest guest(m_impl->capabilities, gl::Visit::Copy);
  m_impl->body(id, "Renderer::updateBody").cells.update(poses, springsIntact);
}

void Renderer::setDebris(std::span<const DebrisInstance> debris) {
  for (const DebrisInstance& piece : debris) m_impl->checkPiece(piece);
  for (auto& [id, body] : m_impl->bodies) body.debris.clear();
  for (const DebrisInstance& piece : debris) {
    const auto it = m_impl->bodies.find(piece.body);
    if (it != m_impl->bodies.end()) it->second.debris.add(piece);
  }
}

void Renderer::setDust(const DustGrid* grid, const DustLook& look) {
  if (!limits::kDustOpacity.hold(look.opacity))
    throw Error("DustLook::opacity must be " + limits::kDustOpacity.text());
  m_impl->grid = grid;
  m_impl->dustLook = look;
}

PropId Renderer::addSphere(float radius, const PropLook& look) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw Error("Renderer::addSphere: the radius must be positive");
  return m_impl->addProp(sphereShape(radius, kSphereLevels), look);
}

PropId Renderer::addBox(const Eigen::Vector3f& halfExtents, const PropLook& look) {
  if (!(halfExtents.minCoeff() > 0) || !halfExtents.allFinite()) {
    throw Error("Renderer::addBox: the half extents must be positive");
  }
  return m_impl->addProp(boxShape(halfExtents), look);
}

PropId Renderer::addHull(std::span<const Eigen::Vector3f> vertices,
                         std::span<const std::array<std::uint32_t, 3>> triangles, const PropLook& look) {
  for (const Eigen::Vector3f& vertex : vertices) {
    if (!vertex.allFinite()) throw Error("Renderer::addHull: a vertex is not finite");
  }
  for (const auto& triangle : triangles) {
    for (const std::uint32_t v : triangle) {
      if (v >= vertices.size()) throw Error("Renderer::addHull: there is no vertex " + std::to_string(v));
    }
  }
  return m_impl->addProp(flatShape(vertices, triangles), look);
}

void Renderer::setPropPose(PropId prop, const Eigen::Vector3f& position,
                           const Eigen::Quaternionf& orientation) {
  const auto it = m_impl->props.find(prop);
  if (it == m_impl->props.end()) {
    throw Error("Renderer::setPropPose: there is no prop " + std::to_string(std::uint32_t(prop)));
  }
  it->second.setPose(position, orientation);
}

void Renderer::removeProp(PropId prop) {
  if (m_impl->props.erase(prop) == 0) {
    throw Error("Renderer::removeProp: there is no prop " + std::to_string(std::uint32_t(prop)));
  }
}

void Renderer::addGroundPlane(float height, const Eigen::Vector3f& colour) {
  if (!std::isfinite(height)) throw Error("Renderer::addGroundPlane: the height is not finite");
  m_impl->ground = Impl::Ground{height, colour};
}

void Renderer::draw(const Camera& camera, const Lighting& lighting, const FrameTarget& target) {
  Impl& r = *m_impl;
  const gl::Guest guest(r.capabilities);
  r.forgetRemoved();
  r.times = {};
  r.timed(r.times.upload, [&] { r.upload(camera, lighting, target); });
  r.setSolidState();
  r.timed(r.times.shadow, [&] { r.drawShadows(); });
  r.timed(r.times.dustVolume, [&] { r.lightDust(); });
  r.timed(r.times.cells, [&] { r.drawCells(); });
  r.timed(r.times.debris, [&] { r.drawDebris(); });
  r.timed(r.times.props, [&] { r.drawProps(); });
  r.timed(r.times.sky, [&] { r.drawGroundAndSky(); });
  r.timed(r.times.resolve, [&] { r.scene.resolve(); });
  r.timed(r.times.dust, [&] { r.marchDust(); });
  r.timed(r.times.composite, [&] { r.composite(target); });
  gl::checkGl("drawing a frame");
}

const PassTimes& Renderer::passTimes() const {
  return m_impl->times;
}
const DrawCounts& Renderer::counts() const {
  return m_impl->counts;
}

}  // namespace rubble
