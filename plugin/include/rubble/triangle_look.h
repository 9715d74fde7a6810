// What an application draws the triangles of an asset with, whether or not the mesh had texture coordinates
// and materials. Normals stand in Asset::corners.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "rubble/asset.h"

namespace rubble {

struct TriangleLook {
  /// Into Asset::materialNames on outer faces (0 if there are none), Asset::innerMaterial() on inner ones.
  std::uint32_t material;
  /// Of the triangle's corners: the mesh's own, or boxUv along the triangle's normal where there are none.
  std::array<Eigen::Vector2f, 3> uvs;
};

/// One a triangle of the asset, in the same order.
std::vector<TriangleLook> triangleLooks(const Asset& asset);

/// Texture coordinates of a place at rest, by projection along the axis that the normal is nearest to [m].
/// Seen from outside they are not mirrored, and where the sides are vertical (y is up) the second one points
/// up. The first of axes that are equally near is taken.
Eigen::Vector2f boxUv(const Eigen::Vector3f& place, const Eigen::Vector3f& normal);

}  // namespace rubble
