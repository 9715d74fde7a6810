#include "render/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "rubble/limits.h"

namespace rubble {

namespace {

// `up`, or where that is along the view what it becomes when one who looks along -z tilts the head: -z for a
// look down, z for a look up. With another axis up, the axis that is least along the view.
Eigen::Vector3f usableUp(const Eigen::Vector3f& up, const Eigen::Vector3f& back) {
  constexpr float kAlong = 1e-3f;  // sine of the angle to the view; less would turn the picture by rounding
  const Eigen::Vector3f unit = up.normalized();
  if (unit.cross(back).norm() > kAlong) return unit;
  const float side = unit.dot(back) > 0 ? -1.f : 1.f;
  const bool isZ = std::abs(back.z()) < 0.5f;
  return side * (isZ ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX());
}

}  // namespace

Eigen::Matrix4f Camera::view() const {
  const Eigen::Vector3f back = (eye - target).normalized();
  const Eigen::Vector3f right = usableUp(up, back).cross(back).normalized();
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.block<1, 3>(0, 0) = right;
  m.block<1, 3>(1, 0) = back.cross(right);
  m.block<1, 3>(2, 0) = back;
  m.topRightCorner<3, 1>() = -(m.topLeftCorner<3, 3>() * eye);
  return m;
}

Eigen::Matrix4f Camera::projection(float aspect) const {
  const float scale = 1 / std::tan(verticalFov / 2);
  const float depth = nearPlane - farPlane;
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m(0, 0) = scale / aspect;
  m(1, 1) = scale;
  m(2, 2) = (farPlane + nearPlane) / depth;
  m(2, 3) = 2 * farPlane * nearPlane / depth;
  m(3, 2) = -1;
  return m;
}

namespace render {
namespace {

// Picture sides beyond this are refused by no driver of ours but by memory.
constexpr int kMaxSide = 16384;
// The receiver is lifted off its surface by this many shadow texels, so that it does not shade itself.
constexpr float kNormalOffsetTexels = 1.5f;
// Casters may stand this much nearer to the sun than the box, as a share of its depth.
constexpr float kRoomTowardsSun = 1;

void require(bool ok, const char* what) {
  if (!ok) throw Error(std::string("Renderer::draw: ") + what);
}

void check(const FrameDef& def) {
  const Camera& camera = *def.camera;
  require(def.target.width > 0 && def.target.height > 0 && def.target.width <= kMaxSide &&
              def.target.height <= kMaxSide,
          "the picture must be 1 to 16384 pixels wide and high");
  require(camera.eye.allFinite() && camera.target.allFinite() && camera.up.allFinite(),
          "the camera is not finite");
  require(camera.eye != camera.target, "the camera's eye must differ from its target");
  require(camera.up.norm() > 0, "the camera's up has no direction");
  constexpr double kDegree = std::numbers::pi / 180;
  const Limits view = {limits::kFieldOfView.low * kDegree, limits::kFieldOfView.high * kDegree};
  require(view.hold(camera.verticalFov), "the field of view must be 0.1 to 179 degrees");
  require(camera.nearPlane > 0 && camera.farPlane > camera.nearPlane && std::isfinite(camera.farPlane),
          "0 < nearPlane < farPlane must hold");
  const Eigen::Vector3f& sun = def.lighting->sunDirection;
  require(sun.allFinite() && sun.y() > 0, "the sun must stand above the horizon");
  require(def.lighting->exposure > 0 && std::isfinite(def.lighting->exposure),
          "the exposure must be positive");
  require(def.lighting->grainScale > 0 && std::isfinite(def.lighting->grainScale),
          "the scale of the grain must be positive");
  require(def.lighting->haze > 0 && std::isfinite(def.lighting->haze), "the haze must be positive");
}

}  // namespace

Eigen::Matrix4f shadowMatrix(const Eigen::AlignedBox3f& bounds, const Eigen::Vector3f& toSun) {
  const Eigen::Vector3f side =
      toSun.cross(std::abs(toSun.y()) < 0.99f ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitX())
          .normalized();
  Eigen::Matrix3f axes;
  axes << side.transpose(), toSun.cross(side).transpose(), -toSun.transpose();
  Eigen::AlignedBox3f box;
  for (int i = 0; i < 8; ++i) {
    box.extend(Eigen::Vector3f(axes * bounds.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i))));
  }
  box.min().z() -= kRoomTowardsSun * box.sizes().z();
  const Eigen::Vector3f scale = box.sizes().cwiseMax(1e-6f).cwiseInverse();
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  m.topRightCorner<3, 1>() = -scale.cwiseProduct(box.min());
  return m;
}

shared::Frame makeFrame(const FrameDef& def) {
  check(def);
  const Camera& camera = *def.camera;
  const Lighting& light = *def.lighting;
  const auto width = float(def.target.width), height = float(def.target.height);
  const Eigen::Vector3f toSun = light.sunDirection.normalized();
  shared::Frame frame{};
  frame.viewProjection = camera.projection(width / height) * camera.view();
  frame.inverseViewProjection = frame.viewProjection.cast<double>().inverse().cast<float>();
  frame.worldToShadow = shadowMatrix(def.shadowBounds, toSun);
  frame.worldToDustLight.setIdentity();
  frame.dustLightToWorld.setIdentity();
  frame.eye = withW(camera.eye, 1);
  const float texel = 1 / (std::min(frame.worldToShadow.block<1, 3>(0, 0).norm(),
                                    frame.worldToShadow.block<1, 3>(1, 0).norm()) *
                           float(def.shadowMapSize));
  frame.sunDirection = withW(toSun, kNormalOffsetTexels * texel);
  frame.sunColour = withW(light.sunColour, 0);
  frame.skyAmbient = withW(light.skyAmbient, 0);
  frame.groundAmbient = withW(light.groundAmbient, 0);
  frame.skyZenith = withW(light.skyZenith, 0);
  frame.skyHorizon = withW(light.skyHorizon, 0);
  frame.viewport = {width, height, 1 / width, 1 / height};
  frame.tone = {light.exposure, light.toneCurve ? 1.f : 0.f, light.grainScale, light.haze};
  frame.dustMin.setZero();
  frame.dustMax.setZero();
  frame.dustColour.setZero();
  return frame;
}

}  // namespace render
}  // namespace rubble
