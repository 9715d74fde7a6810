// Distance to the solid's surface, negative inside.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

struct Distance {
  double value;              ///< [m], negative inside
  Eigen::Vector3d gradient;  ///< unit length or nearly; where it grows
};

class SignedDistance {
 public:
  virtual ~SignedDistance() = default;
  /// Makes `fast` good enough for elements of this radius [m].
  virtual void fitTo(double radius) = 0;
  /// Fast, asked in every iteration of the packing. Only good enough to keep elements inside: deeper than two
  /// radii it may say two radii, far outside it may say up to half as much again.
  virtual Distance fast(const Eigen::Vector3d& place) const = 0;
  /// Right to rounding.
  virtual Distance exact(const Eigen::Vector3d& place) const = 0;
  /// `fast` may be wrong by this much near edges of the surface [m]; 0: both are the same.
  virtual double fastError() const = 0;
};

/// Analytic where the mesh is a box along the axes, else a grid. The mesh must outlive it. Not for two
/// threads at once.
std::unique_ptr<SignedDistance> signedDistance(const CheckedMesh& mesh);

}  // namespace rubble::cooking
