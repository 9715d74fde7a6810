#include "demo/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace rubble::demo {
namespace {

constexpr float kTurn = 0.006f;    // [rad/pixel]
constexpr float kSteepest = 1.5f;  // [rad]: beyond, `up` is along the view
constexpr float kApproach = 0.9f;  // factor on the distance for one notch
constexpr float kNearest = 0.05f;  // of the distance at the start
constexpr float kFurthest = 30;    // of the distance at the start

}  // namespace

OrbitCamera::OrbitCamera(const Camera& start) : m_camera(start) {
  const Eigen::Vector3f arm = start.eye - start.target;
  m_distance = m_start = arm.norm();
  m_yaw = std::atan2(arm.x(), arm.z());
  m_pitch = std::clamp(std::asin(arm.y() / m_distance), -kSteepest, kSteepest);
  place();
}

void OrbitCamera::turn(float rightPixels, float downPixels) {
  m_yaw -= kTurn * rightPixels;
  m_pitch = std::clamp(m_pitch + kTurn * downPixels, -kSteepest, kSteepest);
  place();
}

void OrbitCamera::approach(float notches) {
  m_distance = std::clamp(m_distance * std::pow(kApproach, notches), kNearest * m_start, kFurthest * m_start);
  place();
}

Eigen::Vector3f OrbitCamera::ray(float x, float y, float aspect) const {
  const Eigen::Vector3f forward = (m_camera.target - m_camera.eye).normalized();
  const Eigen::Vector3f right = forward.cross(m_camera.up).normalized();
  const Eigen::Vector3f up = right.cross(forward);
  const float half = std::tan(m_camera.verticalFov / 2);
  return (forward + right * ((2 * x - 1) * half * aspect) + up * ((1 - 2 * y) * half)).normalized();
}

void OrbitCamera::place() {
  const Eigen::Vector3f arm(std::sin(m_yaw) * std::cos(m_pitch), std::sin(m_pitch),
                            std::cos(m_yaw) * std::cos(m_pitch));
  m_camera.eye = m_camera.target + m_distance * arm;
}

}  // namespace rubble::demo
