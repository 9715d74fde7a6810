// Signed distance of any closed mesh: interpolated on a grid where speed counts, exact where it does not.
// Both by a tree of the triangles: a node of the grid is measured when it is first asked for. Only those near
// elements near the surface ever are, so neither a solid that fills little of its bounds nor triangles that
// lie aslant in them cost more than others; what a node holds depends on its place alone, never on the order
// of the questions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cook/signed_distance.h"
#include "cook/triangle_tree.h"

namespace rubble::cooking {

class GridDistance final : public SignedDistance {
 public:
  /// The mesh must outlive this.
  explicit GridDistance(const CheckedMesh& mesh);

  void fitTo(double radius) override;
  Distance fast(const Eigen::Vector3d& place) const override;
  Distance exact(const Eigen::Vector3d& place) const override;
  double fastError() const override { return m_spacing; }

  /// Between nodes [m].
  double spacing() const { return m_spacing; }
  /// Nodes hold no distances larger than this, inside or outside [m].
  double reach() const { return m_reach; }
  /// Nodes measured so far, in all grids.
  std::size_t nodesMeasured() const { return m_nodesMeasured; }
  const TriangleTree& tree() const { return m_tree; }

 private:
  static constexpr int kBlockBits = 2;
  static constexpr int kBlockEdge = 1 << kBlockBits;                                   // [nodes]
  using Block = std::array<float, std::size_t(kBlockEdge) * kBlockEdge * kBlockEdge>;  // [m]; NaN: not yet

  Distance farOutside(const Eigen::Vector3d& place) const;
  Block& block(std::uint64_t key) const;
  bool holds(const Eigen::Vector3d& place, double distance) const;
  double nodeValue(const std::array<std::int32_t, 3>& node) const;
  float measure(const std::array<std::int32_t, 3>& node, const Block& nodes, std::size_t inBlock) const;

  const CheckedMesh& m_mesh;
  TriangleTree m_tree;
  Eigen::Vector3d m_origin;
  double m_spacing = 0;
  double m_reach = 0;
  mutable std::unordered_map<std::uint64_t, Block> m_blocks;
  // The blocks asked for last, by some bits of their keys.
  struct Known {
    std::uint64_t key = 0;
    Block* block = nullptr;
  };
  mutable std::vector<Known> m_known;
  // The place last measured exactly, and its signed distance; 0: none that says anything about its side.
  mutable Eigen::Vector3d m_lastPlace = Eigen::Vector3d::Zero();
  mutable double m_lastValue = 0;
  mutable std::size_t m_nodesMeasured = 0;
};

}  // namespace rubble::cooking
