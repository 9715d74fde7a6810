// Signed distance of a box along the axes.
#pragma once

#include <Eigen/Geometry>

#include "cook/signed_distance.h"

namespace rubble::cooking {

class BoxDistance final : public SignedDistance {
 public:
  explicit BoxDistance(const Eigen::AlignedBox3d& box) : m_box(box) {}

  /// Fills its bounds: no other closed surface does.
  static bool isBox(const CheckedMesh& mesh);

  void fitTo(double) override {}
  Distance fast(const Eigen::Vector3d& place) const override { return exact(place); }
  Distance exact(const Eigen::Vector3d& place) const override;
  double fastError() const override { return 0; }

 private:
  Eigen::AlignedBox3d m_box;
};

}  // namespace rubble::cooking
