// Draws cells, debris, rigid props and dust in the caller's current OpenGL 4.3+ core context. Takes plain
// data: knows nothing of Bullet nor of the simulation. The same input gives the same image on the same GL
// implementation, whatever state the caller has set.
//
// Every call finds its own way about the context and leaves the caller's state as it was: bindings, viewport,
// switches, masks, pixel storage. There are four exceptions. Errors that the caller has not fetched by
// glGetError are discarded; no call throws for them. A conditional render in progress is ended before objects
// are made, pixels read or pictures drawn, for OpenGL does not tell which it was. Queries in progress count
// what is drawn. A program that the caller has deleted while it is in use is gone afterwards. A transform
// feedback in progress is paused meanwhile, and goes on.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rubble/asset.h"
#include "rubble/dust.h"
#include "rubble/error.h"
#include "rubble/material.h"
#include "rubble/pose.h"

namespace rubble {

struct Camera {
  Eigen::Vector3f eye = Eigen::Vector3f(2, 1.5f, 3);     ///< [m]
  Eigen::Vector3f target = Eigen::Vector3f(0, 0.5f, 0);  ///< [m], must differ from the eye
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();         ///< any length; along the view another is taken
  float verticalFov = 0.7f;                              ///< full angle [rad], limits::kFieldOfView
  float nearPlane = 0.05f;                               ///< [m], > 0
  float farPlane = 200;                                  ///< [m], > nearPlane

  Eigen::Matrix4f view() const;
  Eigen::Matrix4f projection(float aspect) const;  ///< aspect = width / height; depth -1 to 1
};

/// Colours are linear RGB. A white surface facing the sun sends back sunColour (the 1 / pi of a diffuse
/// surface is in it).
struct Lighting {
  /// Towards the sun, any length, y > 0.
  Eigen::Vector3f sunDirection = Eigen::Vector3f(-0.55f, 0.72f, 0.42f);
  Eigen::Vector3f sunColour = Eigen::Vector3f(2.75f, 2.5f, 2.15f);
  Eigen::Vector3f skyAmbient = Eigen::Vector3f(0.34f, 0.41f, 0.52f);     ///< from straight above, on surfaces
  Eigen::Vector3f groundAmbient = Eigen::Vector3f(0.2f, 0.18f, 0.155f);  ///< from straight below, on surfaces
  Eigen::Vector3f skyZenith = Eigen::Vector3f(0.1f, 0.17f, 0.29f);       ///< background
  Eigen::Vector3f skyHorizon = Eigen::Vector3f(0.46f, 0.53f, 0.61f);     ///< background
  float exposure = 0.62f;  ///< factor in front of the tone curve, dimensionless
  bool toneCurve = true;   ///< false: light is clamped to [0, 1] and only gamma is applied (measurements)
  /// Size of the grain of solids and floor and of the floor's joints, over that of a scene of metres (joints
  /// every metre), dimensionless, > 0.
  float grainScale = 1;
  /// Share of the floor's light that is lost in haze per metre, > 0 [1/m]. The air is clear up to 0.3 / haze,
  /// and the floor reaches 6 / haze from the eye; give the camera a far plane beyond.
  float haze = 0.05f;
  /// Only what is inside this box casts shadows. Unset: the bodies where they were first placed, and a
  /// diagonal of room around them.
  std::optional<Eigen::AlignedBox3f> shadowBounds;
};

/// Linear RGB albedo of a body's surface and of its fracture faces.
struct CellColours {
  Eigen::Vector3f outer = Eigen::Vector3f(0.62f, 0.6f, 0.565f);
  Eigen::Vector3f inner = Eigen::Vector3f(0.43f, 0.395f, 0.35f);
};

/// Look of a rigid prop.
struct PropLook {
  Eigen::Vector3f colour = Eigen::Vector3f(0.1f, 0.11f, 0.125f);  ///< linear RGB albedo
  float gloss = 0.5f;  ///< strength of the highlight, 0 (chalk) to 1 (lacquer)
};

struct DustLook {
  float opacity = 1;  ///< factor on the mass extinction, 0 to 1000, dimensionless; 1 is real dust
  Eigen::Vector3f colour = Eigen::Vector3f(0.8f, 0.755f, 0.69f);  ///< single-scattering albedo, linear RGB
};

enum class BodyId : std::uint32_t {};
enum class PropId : std::uint32_t {};

/// A piece of debris: the cell of `element` scaled about the element's centre (paper 3.2).
struct DebrisInstance {
  Eigen::Vector3f position;        ///< [m]
  float scale;                     ///< of the cell mesh
  Eigen::Quaternionf orientation;  ///< unit
  BodyId body;
  std::uint32_t element;
};

/// Where draw() puts the picture. 0 is the window's framebuffer.
struct FrameTarget {
  std::uint32_t framebuffer = 0;
  int width = 1280;
  int height = 720;
};

struct RendererDef {
  std::string shaderDirectory;  ///< holds draw/ and shared/
  int samples = 4;              ///< of multisample anti-aliasing: 1, 2, 4 or 8, at most what the driver has
  int shadowMapSize = 2048;     ///< texels along a side, 256 to 8192
  int dustSteps = 64;           ///< of a ray through the dust, 8 to 512
  /// Measures every pass with glFinish around it: slow, for reports only.
  bool measurePasses = false;
};

/// Milliseconds of the last draw(), when RendererDef::measurePasses is set.
struct PassTimes {
  double upload = 0, shadow = 0, dustVolume = 0, cells = 0, debris = 0, props = 0, sky = 0, resolve = 0,
         dust = 0, composite = 0;
  double total() const;
};

struct DrawCounts {
  std::size_t cellTriangles = 0;  ///< drawn, of all bodies
  std::size_t debrisTriangles = 0;
  std::size_t debrisPieces = 0;    ///< drawn
  std::size_t debrisTooSmall = 0;  ///< left out: would cover less than a small share of a pixel
};

/// A picture in memory: RGBA8, sRGB encoded, first row on top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< (height x width x 4)
};

/// An offscreen target for headless runs: RGBA8 and depth. Needs the context it was made in.
class Framebuffer {
 public:
  Framebuffer(int width, int height);
  ~Framebuffer();
  Framebuffer(Framebuffer&&) noexcept;
  Framebuffer& operator=(Framebuffer&&) noexcept;

  FrameTarget target() const;
  /// Waits for the picture and copies it out.
  Image readPixels() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

/// Everything that is drawn. Every call needs the context it was made in to be current. Bad ids, sizes and
/// numbers are refused with rubble::Error.
class Renderer {
 public:
  explicit Renderer(const RendererDef& def);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Copies what it needs of the asset. The body stands at rest until its first update.
  BodyId addBody(const Asset& asset, CellJoining joining = CellJoining::Transitive,
                 const CellColours& colours = {});
  /// It is drawn no more and its id is refused, but for its debris: see setDebris.
  void removeBody(BodyId body);
  /// Poses of all elements (n), and 1 for each unbroken spring (springs first; what follows, the anchors, is
  /// not looked at).
  void updateBody(BodyId body, std::span<const ElementPose> poses,
                  std::span<const std::uint8_t> springsIntact);

  /// Copies the pieces; they are drawn until the next call. Debris outlive their body: pieces of a removed
  /// one are drawn from its cells, which are kept until the first draw() without any piece of it; after that
  /// they are left out. Bodies that never were are refused.
  void setDebris(std::span<const DebrisInstance> debris);

  /// The grid is read in every draw() and must live until setDust(nullptr). Null: no dust.
  void setDust(const DustGrid* grid, const DustLook& look = {});

  PropId addSphere(float radius, const PropLook& look = {});                     ///< radius [m]
  PropId addBox(const Eigen::Vector3f& halfExtents, const PropLook& look = {});  ///< [m]
  /// A convex hull or any other closed mesh, flat shaded; triangles counter-clockwise seen from outside.
  PropId addHull(std::span<const Eigen::Vector3f> vertices,
                 std::span<const std::array<std::uint32_t, 3>> triangles, const PropLook& look = {});
  void setPropPose(PropId prop, const Eigen::Vector3f& position, const Eigen::Quaternionf& orientation);
  void removeProp(PropId prop);

  /// An endless floor at y = height [m]; one at most, the last call holds.
  void addGroundPlane(float height, const Eigen::Vector3f& colour = Eigen::Vector3f(0.15f, 0.15f, 0.148f));

  void draw(const Camera& camera, const Lighting& lighting, const FrameTarget& target);

  const PassTimes& passTimes() const;
  const DrawCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace rubble
