// Integrals over a closed triangle mesh, one triangle at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rubble::cooking {

/// Sums over the tetrahedra between the triangles and `origin`, a point near the solid (it limits the
/// cancellation).
class PolyhedronIntegrals {
 public:
  explicit PolyhedronIntegrals(const Eigen::Vector3d& origin) : m_origin(origin) {}

  /// Counter-clockwise seen from outside.
  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
    const Eigen::Vector3d a = p - m_origin;
    const Eigen::Vector3d b = q - m_origin;
    const Eigen::Vector3d c = r - m_origin;
    const Eigen::Vector3d sum = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    m_volume += volume;
    m_first += volume / 4 * sum;
    m_second +=
        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }

  double volume() const { return m_volume; }  // [m^3]
  Eigen::Vector3d centroid() const { return m_origin + m_first / m_volume; }
  /// Mean of d d^T, d from the centroid [m^2].
  Eigen::Matrix3d spread() const {
    const Eigen::Vector3d centre = m_first / m_volume;
    return m_second / m_volume - centre * centre.transpose();
  }
  /// A third of the trace of the inertia tensor about the centroid, of unit mass [m^2]. The trace is twice
  /// the mean of the squared distance, since each axis misses one of three squares.
  double gyration() const { return 2 * spread().trace() / 3; }
  /// Of a box that spreads alike, along its thinnest axis [m].
  double thickness() const {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(spread(), Eigen::EigenvaluesOnly);
    return std::sqrt(12 * std::max(eigen.eigenvalues()[0], 0.0));
  }

 private:
  Eigen::Vector3d m_origin;
  double m_volume = 0;
  Eigen::Vector3d m_first = Eigen::Vector3d::Zero();   // integral of x
  Eigen::Matrix3d m_second = Eigen::Matrix3d::Zero();  // integral of x x^T
};

}  // namespace rubble::cooking
