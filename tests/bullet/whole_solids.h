// Solids that are not convex, whole bodies of which are compounds, for tests.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bullet/bullet_world.h"
#include "rubble/destructible_body.h"
#include "support/strict_cook.h"

namespace rubble::test {

using Profile = std::vector<std::array<double, 2>>;

/// The outline, counter-clockwise, pulled along z by `depth`; the triangles are of its points.
inline std::shared_ptr<const Asset> pulled(const Profile& outline,
                                           const std::vector<std::array<std::uint32_t, 3>>& fill,
                                           double depth, int elements) {
  const auto n = std::uint32_t(outline.size());
  SurfaceMesh mesh;
  for (const double z : {-depth / 2, depth / 2})
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], p[1], z);
  for (const auto& t : fill) {
    mesh.triangles.push_back({t[2], t[1], t[0]});
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, j + n});
    mesh.triangles.push_back({i, j + n, i + n});
  }
  CookOptions options;
  options.elements = elements;
  return std::make_shared<const Asset>(cookStrictly(mesh, options));
}

/// Two arms of 0.4 m, 0.1 m thick: boxes of 0.4 x 0.1 and 0.1 x 0.3.
inline std::shared_ptr<const Asset> ell() {
  static const auto asset = pulled({{0, 0}, {0.4, 0}, {0.4, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.4}},
                                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 0.1, 100);
  return asset;
}

/// A top of 0.6 x 0.1 m on two legs of 0.1 m, 0.4 m high.
inline std::shared_ptr<const Asset> table() {
  static const auto asset =
      pulled({{-0.3, 0}, {-0.2, 0}, {-0.2, 0.4}, {0.2, 0.4}, {0.2, 0}, {0.3, 0}, {0.3, 0.5}, {-0.3, 0.5}},
             {{0, 1, 2}, {0, 2, 7}, {2, 3, 7}, {3, 6, 7}, {3, 4, 6}, {4, 5, 6}}, 0.4, 300);
  return asset;
}

inline DestructibleBodyDef defOf(std::shared_ptr<const Asset> asset,
                                 Regime regime = Regime::RigidUntilStruck) {
  DestructibleBodyDef def;
  def.asset = std::move(asset);
  def.material = material("concrete_soft");
  def.anchored = false;
  def.regime = regime;
  return def;
}

}  // namespace rubble::test
