// Integrals over a closed triangle mesh, one triangle at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

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
    const double volume = a.dot(b.cross(c)) / 6;
    m_volume += volume;
    m_first += volume / 4 * (a + b + c);
    m_second +=
        volume / 10 * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + a.dot(b) + b.dot(c) + c.dot(a));
  }

  double volume() const { return m_volume; }  // [m^3]
  Eigen::Vector3d centroid() const { return m_origin + m_first / m_volume; }
  /// A third of the trace of the inertia tensor about the centroid, of unit mass [m^2]. The trace is twice
  /// the integral of the squared distance, since each axis misses one of three squares.
  double gyration() const {
    const double aboutCentroid = m_second / m_volume - (m_first / m_volume).squaredNorm();
    return 2 * aboutCentroid / 3;
  }

 private:
  Eigen::Vector3d m_origin;
  double m_volume = 0;
  Eigen::Vector3d m_first = Eigen::Vector3d::Zero();  // integral of x
  double m_second = 0;                                // integral of |x|^2
};

}  // namespace rubble::cooking
