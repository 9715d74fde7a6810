#include "debris/swarm.h"

#include <Eigen/Geometry>

namespace rubble::debris {

namespace {

// About an axis with less than this share of the largest moment the points are as good as collinear: the
// angular momentum about it is rounding, and dividing by the moment would make a velocity of it.
constexpr double kCollinear = 1e-10;

}  // namespace

void removeMean(std::span<const double> masses, std::span<Eigen::Vector3d> values) {
  double mass = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < values.size(); ++n) {
    mass += masses[n];
    sum += masses[n] * values[n];
  }
  if (!(mass > 0)) return;
  sum /= mass;
  for (Eigen::Vector3d& value : values) value -= sum;
}

Eigen::Vector3d angularMomentum(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets,
                                std::span<const Eigen::Vector3d> velocities) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < offsets.size(); ++n) sum += masses[n] * offsets[n].cross(velocities[n]);
  return sum;
}

double kineticEnergy(std::span<const double> masses, std::span<const Eigen::Vector3d> velocities) {
  double sum = 0;
  for (std::size_t n = 0; n < velocities.size(); ++n) sum += 0.5 * masses[n] * velocities[n].squaredNorm();
  return sum;
}

PrincipalInertia principalInertia(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < offsets.size(); ++n) {
    const Eigen::Vector3d& o = offsets[n];
    tensor += masses[n] * (o.squaredNorm() * Eigen::Matrix3d::Identity() - o * o.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  return {solver.eigenvalues().cwiseMax(0.0), solver.eigenvectors()};
}

void removeRotation(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets,
                    const PrincipalInertia& inertia, std::span<Eigen::Vector3d> velocities) {
  const Eigen::Vector3d momentum = angularMomentum(masses, offsets, velocities);
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double moment = inertia.moments[axis];
    if (!(moment > kCollinear * inertia.moments[2])) continue;
    const Eigen::Vector3d direction = inertia.axes.col(axis);
    rate += direction * (direction.dot(momentum) / moment);
  }
  for (std::size_t n = 0; n < velocities.size(); ++n) velocities[n] -= rate.cross(offsets[n]);
}

}  // namespace rubble::debris
