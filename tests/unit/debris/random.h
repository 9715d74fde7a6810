// Random numbers that are the same with every standard library.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <random>

namespace rubble::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : m_engine(seed) {}

  double uniform(double least, double most) {
    return least + (most - least) * double(m_engine() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d inBall(double radius) {
    for (;;) {
      const Eigen::Vector3d v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.squaredNorm() <= 1) return radius * v;
    }
  }
  Eigen::Vector3d direction() { return (inBall(1) + Eigen::Vector3d(1e-9, 0, 0)).normalized(); }
  Eigen::Quaterniond rotation() { return Eigen::Quaterniond(Eigen::AngleAxisd(uniform(-3, 3), direction())); }

 private:
  std::mt19937_64 m_engine;
};

}  // namespace rubble::test
