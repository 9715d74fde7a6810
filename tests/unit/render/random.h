// Numbers for tests that want many unlike cases and the same ones every time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "rubble/asset.h"
#include "rubble/pose.h"

namespace rubble::test {

class Random {  // a linear congruential generator [Knuth, MMIX]
 public:
  explicit Random(std::uint64_t seed) : m_state(seed) {}
  float unit() {
    m_state = m_state * 6364136223846793005u + 1442695040888963407u;
    return float(m_state >> 40) / float(1u << 24);
  }
  Eigen::Vector3f vector() {  // in [-1, 1]^3
    const float x = unit(), y = unit(), z = unit();
    return 2 * Eigen::Vector3f(x, y, z) - Eigen::Vector3f::Ones();
  }
  std::uint32_t below(std::size_t n) { return std::uint32_t(unit() * float(n)) % std::uint32_t(n); }

 private:
  std::uint64_t m_state;
};

inline std::vector<ElementPose> restPoses(const Asset& asset) {
  std::vector<ElementPose> poses;
  for (const Eigen::Vector3d& position : asset.positions) {
    poses.push_back({position.cast<float>(), 1, Eigen::Vector4f(0, 0, 0, 1)});
  }
  return poses;
}

/// Each element moved by up to `distance` [m] along each axis and turned by up to about `angle` [rad].
inline std::vector<ElementPose> shakenPoses(const Asset& asset, Random& random, float distance, float angle) {
  std::vector<ElementPose> poses = restPoses(asset);
  for (ElementPose& pose : poses) {
    pose.position += distance * random.vector();
    const Eigen::Vector3f turn = angle * random.vector();
    pose.rotation = Eigen::Quaternionf(1, turn.x() / 2, turn.y() / 2, turn.z() / 2).normalized().coeffs();
  }
  return poses;
}

}  // namespace rubble::test
