// Which elements a drawn cell vertex follows: the weights of eq. (8), one nibble for each of the (at most
// four) copies of a cell vertex. Plain C++; changes only at the vertices of broken springs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rubble/asset.h"
#include "rubble/material.h"
#include "rubble/pose.h"

namespace rubble::render {

/// Four nibbles: bit J of nibble I is the weight of the vertex's element J in the copy that belongs to its
/// element I.
using CellMask = std::uint16_t;

inline unsigned maskOf(CellMask mask, unsigned owner) {
  return (mask >> (4 * owner)) & 15u;
}

/// Compressed rows: items of row r are items[first[r]] .. items[first[r + 1] - 1].
struct Rows {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> items;
  std::span<const std::uint32_t> row(std::size_t r) const {
    return {items.data() + first[r], first[r + 1] - first[r]};
  }
};

/// The masks of one body.
///
/// Transitive: a copy follows every element that is joined with its owner through any chain of joined pairs
/// at the vertex. A pair of elements is joined by its unbroken spring; a pair that never had one (its face is
/// a sliver, or it touches in an edge) is joined while some third element at one of the pair's common
/// vertices holds both by unbroken springs. Without the latter an intact object would show cracks where such
/// a face reaches the surface. Direct (the paper): a copy follows the elements joined with its owner by a
/// spring of their own.
class CellWeights {
 public:
  CellWeights(const Asset& asset, CellJoining joining);

  /// Springs are unbroken where springsIntact is not 0 (at least as many as the asset's springs) and both
  /// ends are alive (poses, one an element). Returns true when a mask has changed; changed() then lists the
  /// vertices, ascending.
  bool update(std::span<const std::uint8_t> springsIntact, std::span<const ElementPose> poses);

  std::span<const CellMask> masks() const { return m_masks; }
  std::span<const std::uint32_t> changed() const { return m_changed; }

 private:
  void findPairs(const Asset& asset);
  void findBridges(const Asset& asset, std::span<const std::array<std::uint32_t, 2>> pairs);
  void setPair(std::uint32_t pair, bool joined);
  bool bridged(std::uint32_t bridgedPair) const;
  CellMask maskAt(std::uint32_t vertex) const;

  CellJoining m_joining;
  std::vector<std::array<std::uint32_t, 2>> m_springs;  // elements of each spring
  /// Pair ids at each vertex; springs first, then bridged pairs.
  std::vector<std::array<std::uint32_t, 6>> m_vertexPairs;
  Rows m_pairVertices;                 // pair -> vertices
  Rows m_bridges;                      // bridged pair -> springs, two and two
  std::vector<std::uint8_t> m_joined;  // by pair id
  std::vector<CellMask> m_masks;
  std::vector<std::uint32_t> m_changed;
  std::vector<std::uint8_t> m_isMarked;  // vertices waiting for a new mask
  std::vector<std::uint32_t> m_marked;
};

/// Eq. (8) on the CPU, as cells.vert computes it: where the copy of `vertex` that belongs to the element at
/// place `owner` is [m]. p_A = sum w (x_J + R_J d_AJ) / sum w. DEVIATION: the paper prints x_J alone, which
/// would draw every vertex at a mean of element centres; d_AJ, the vertex relative to J at rest, is what its
/// fig. 4 stores.
Eigen::Vector3f cellPoint(const Asset& asset, std::span<const ElementPose> poses, CellMask mask,
                          std::uint32_t vertex, unsigned owner);

}  // namespace rubble::render
