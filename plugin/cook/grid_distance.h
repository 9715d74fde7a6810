// Signed distance of any closed mesh: sampled on a grid once, interpolated where speed counts, exact by a
// tree of the triangles where it does not.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cook/signed_distance.h"
#include "cook/triangle_tree.h"

namespace rubble::cooking {

class GridDistance final : public SignedDistance {
 public:
  /// The mesh must outlive this. The spacing is as wanted or, where that takes too much memory, wider [m].
  GridDistance(const CheckedMesh& mesh, double wantedSpacing);

  Distance fast(const Eigen::Vector3d& place) const override;
  Distance exact(const Eigen::Vector3d& place) const override;
  double fastError() const override { return m_spacing; }

 private:
  std::size_t node(int x, int y, int z) const {
    return std::size_t(x) +
           std::size_t(m_count[0]) * (std::size_t(y) + std::size_t(m_count[1]) * std::size_t(z));
  }
  Eigen::Vector3d place(int x, int y, int z) const { return m_origin + m_spacing * Eigen::Vector3d(x, y, z); }

  void chooseNodes(double wantedSpacing);
  double distanceTo(std::uint32_t triangle, const Eigen::Vector3d& from) const;
  void measureBand(std::vector<std::uint32_t>& nearest);
  void sweep(std::vector<std::uint32_t>& nearest, std::array<int, 3> direction);
  void applySigns();
  bool crossesLine(std::uint32_t triangle, double y, double z) const;

  const CheckedMesh& m_mesh;
  TriangleTree m_tree;
  Eigen::Vector3d m_origin;
  double m_spacing = 0;
  std::array<int, 3> m_count{};
  std::vector<float> m_values;  // [m]
};

}  // namespace rubble::cooking
