// Closed test solids with known volumes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "rubble/cook.h"

namespace rubble::test {

/// A plane polygon (counter-clockwise, with its triangles) extruded along z from 0 to height.
inline SurfaceMesh extrude(const std::vector<Eigen::Vector2d>& outline,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles, double height) {
  SurfaceMesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double z : {0.0, height})
    for (const Eigen::Vector2d& p : outline) mesh.vertices.emplace_back(p.x(), p.y(), z);
  for (const auto& [a, b, c] : triangles) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + n, b + n, c + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, j + n});
    mesh.triangles.push_back({i, j + n, i + n});
  }
  return mesh;
}

/// An L of three unit squares, 0.5 thick: volume 1.5.
inline SurfaceMesh ell() {
  return extrude({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 0.5);
}

/// Two legs 1 wide and 1 high on a foot 1 high, `gap` apart, 0.5 thick: volume (2 + (2 + gap)) / 2.
inline SurfaceMesh you(double gap) {
  const double right = 1 + gap;
  return extrude({{0, 0}, {right + 1, 0}, {right + 1, 2}, {right, 2}, {right, 1}, {1, 1}, {1, 2}, {0, 2}},
                 {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}}, 0.5);
}

/// A ring about z: `around` x `across` quadrilaterals.
inline SurfaceMesh torus(double ringRadius, double tubeRadius, std::uint32_t around, std::uint32_t across) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / across;
      const double d = ringRadius + tubeRadius * std::cos(v);
      mesh.vertices.emplace_back(d * std::cos(u), d * std::sin(u), tubeRadius * std::sin(v));
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t i1 = (i + 1) % around;
      const std::uint32_t j1 = (j + 1) % across;
      mesh.triangles.push_back({i * across + j, i1 * across + j, i1 * across + j1});
      mesh.triangles.push_back({i * across + j, i1 * across + j1, i * across + j1});
    }
  return mesh;
}

/// A ball of `bands` x 2 `bands` quadrilaterals, its vertices on the sphere.
inline SurfaceMesh ball(double radius, std::uint32_t bands) {
  SurfaceMesh mesh;
  const std::uint32_t around = 2 * bands;
  for (std::uint32_t i = 1; i < bands; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double polar = std::numbers::pi * i / bands;
      const double azimuth = 2 * std::numbers::pi * j / around;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(azimuth),
                                 radius * std::sin(polar) * std::sin(azimuth), radius * std::cos(polar));
    }
  const auto north = std::uint32_t(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, radius);
  mesh.vertices.emplace_back(0, 0, -radius);
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t j1 = (j + 1) % around;
    const std::uint32_t last = (bands - 2) * around;
    mesh.triangles.push_back({north, j, j1});
    mesh.triangles.push_back({north + 1, last + j1, last + j});
    for (std::uint32_t i = 0; i + 2 < bands; ++i) {
      mesh.triangles.push_back({i * around + j, (i + 1) * around + j, (i + 1) * around + j1});
      mesh.triangles.push_back({i * around + j, (i + 1) * around + j1, i * around + j1});
    }
  }
  return mesh;
}

inline SurfaceMesh reversed(SurfaceMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

inline SurfaceMesh joined(SurfaceMesh mesh, const SurfaceMesh& other) {
  const auto shift = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + shift, b + shift, c + shift});
  return mesh;
}

/// A unit cube about the origin with a cubic cavity of edge 0.5: volume 0.875.
inline SurfaceMesh hollowCube() {
  return joined(boxMesh(Eigen::Vector3d::Ones()), reversed(boxMesh(Eigen::Vector3d::Constant(0.5))));
}

/// Turned so that no edge lies along an axis.
inline SurfaceMesh tilted(SurfaceMesh mesh) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turn * vertex;
  return mesh;
}

/// Volume 1 / 6. Its faces lean by one in ninety: no sphere of more than about 5 mm has room.
inline SurfaceMesh needle() {
  return {{{0, 0, 0}, {1, 0, 0}, {90, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// 2 x 2 m, 5 cm thick, of `count` strips from side to side: volume 0.2.
inline SurfaceMesh plateOfStrips(std::uint32_t count) {
  SurfaceMesh mesh;
  const auto vertex = [count](std::uint32_t z, std::uint32_t y, std::uint32_t i) {
    return (2 * z + y) * (count + 1) + i;
  };
  for (const double z : {0.0, 0.05})
    for (const double y : {0.0, 2.0})
      for (std::uint32_t i = 0; i <= count; ++i) mesh.vertices.emplace_back(2.0 * i / count, y, z);
  const auto add = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    add(vertex(0, 0, i), vertex(0, 1, i), vertex(0, 1, i + 1), vertex(0, 0, i + 1));
    add(vertex(1, 0, i), vertex(1, 0, i + 1), vertex(1, 1, i + 1), vertex(1, 1, i));
    add(vertex(0, 0, i), vertex(0, 0, i + 1), vertex(1, 0, i + 1), vertex(1, 0, i));
    add(vertex(0, 1, i), vertex(1, 1, i), vertex(1, 1, i + 1), vertex(0, 1, i + 1));
  }
  add(vertex(0, 0, 0), vertex(1, 0, 0), vertex(1, 1, 0), vertex(0, 1, 0));
  add(vertex(0, 0, count), vertex(0, 1, count), vertex(1, 1, count), vertex(1, 0, count));
  return mesh;
}

/// 2 m wide, walls of 5 mm: volume 8 - 1.99^3.
inline SurfaceMesh shell() {
  return joined(boxMesh(Eigen::Vector3d::Constant(2)), reversed(boxMesh(Eigen::Vector3d::Constant(1.99))));
}

/// The blocks of a grid for which `isFilled(i, j, k)`: block (i, j, k) reaches from x[i], y[j], z[k] to the
/// next ones.
template <class IsFilled>
SurfaceMesh blocks(const std::array<std::vector<double>, 3>& planes, IsFilled&& isFilled) {
  using Place = std::array<std::size_t, 3>;
  SurfaceMesh mesh;
  std::map<Place, std::uint32_t> ids;
  const auto vertex = [&](const Place& p) {
    const auto [entry, isNew] = ids.try_emplace(p, std::uint32_t(mesh.vertices.size()));
    if (isNew) mesh.vertices.emplace_back(planes[0][p[0]], planes[1][p[1]], planes[2][p[2]]);
    return entry->second;
  };
  const auto holds = [&](const Place& b) {  // before the first block wraps round to far behind the last
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (b[axis] >= planes[axis].size() - 1) return false;
    return bool(isFilled(b[0], b[1], b[2]));
  };
  Place b{};
  for (b[0] = 0; b[0] + 1 < planes[0].size(); ++b[0])
    for (b[1] = 0; b[1] + 1 < planes[1].size(); ++b[1])
      for (b[2] = 0; b[2] + 1 < planes[2].size(); ++b[2])
        for (std::size_t axis = 0; holds(b) && axis < 3; ++axis)
          for (const bool isUpper : {false, true}) {
            Place next = b;
            next[axis] += isUpper ? 1 : std::size_t(-1);
            if (holds(next)) continue;
            std::array<std::uint32_t, 4> quad{};
            for (std::size_t corner = 0; corner < 4; ++corner) {
              Place p = b;
              p[axis] += isUpper ? 1 : 0;
              p[(axis + 1) % 3] += corner == 1 || corner == 2 ? 1 : 0;
              p[(axis + 2) % 3] += corner >= 2 ? 1 : 0;
              quad[corner] = vertex(p);
            }
            if (!isUpper) std::swap(quad[1], quad[3]);
            mesh.triangles.push_back({quad[0], quad[1], quad[2]});
            mesh.triangles.push_back({quad[0], quad[2], quad[3]});
          }
  return mesh;
}

/// A top of 1.2 x 0.8 m, `top` thick, on four legs `leg` wide and 0.7 m high that stand 5 cm from its edges.
inline SurfaceMesh table(double top, double leg) {
  return blocks({{{0, 0.05, 0.05 + leg, 1.15 - leg, 1.15, 1.2},
                  {0, 0.7, 0.7 + top},
                  {0, 0.05, 0.05 + leg, 0.75 - leg, 0.75, 0.8}}},
                [](std::size_t i, std::size_t j, std::size_t k) {
                  return j == 1 || ((i == 1 || i == 3) && (k == 1 || k == 3));
                });
}

/// 1 m wide and high, with walls of 5 cm on a foot of 30 cm.
inline SurfaceMesh cup() {
  return blocks({{{0, 0.05, 0.95, 1}, {0, 0.3, 1}, {0, 0.05, 0.95, 1}}},
                [](std::size_t i, std::size_t j, std::size_t k) { return i != 1 || j != 1 || k != 1; });
}

/// A slab of 1 x 0.3 x 1 m with a slot `gap` wide through it, from one side to 0.8 m deep.
inline SurfaceMesh slottedSlab(double gap) {
  return blocks({{{0, 0.5 - gap / 2, 0.5 + gap / 2, 1}, {0, 0.3}, {0, 0.8, 1}}},
                [](std::size_t i, std::size_t, std::size_t k) { return i != 1 || k == 1; });
}

/// A plate of 4 x 4 x `thickness` m and apart from it a cube of the same volume.
inline SurfaceMesh plateAndCube(double thickness) {
  const double edge = std::cbrt(16 * thickness);
  return joined(boxMesh({4, thickness, 4}), boxMesh(Eigen::Vector3d::Constant(edge), {0, 3, 0}));
}

/// A profile (radius, height), from the axis to the axis and upwards, turned about z in `around` steps.
inline SurfaceMesh turned(const std::vector<Eigen::Vector2d>& profile, std::uint32_t around) {
  SurfaceMesh mesh;
  const auto rings = std::uint32_t(profile.size()) - 2;
  for (std::uint32_t i = 1; i <= rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      mesh.vertices.emplace_back(profile[i].x() * std::cos(angle), profile[i].x() * std::sin(angle),
                                 profile[i].y());
    }
  const std::uint32_t bottom = rings * around;
  mesh.vertices.emplace_back(0, 0, profile.front().y());
  mesh.vertices.emplace_back(0, 0, profile.back().y());
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t j1 = (j + 1) % around;
    const std::uint32_t last = (rings - 1) * around;
    mesh.triangles.push_back({bottom, j1, j});
    mesh.triangles.push_back({bottom + 1, last + j, last + j1});
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({i * around + j, i * around + j1, (i + 1) * around + j1});
      mesh.triangles.push_back({i * around + j, (i + 1) * around + j1, (i + 1) * around + j});
    }
  }
  return mesh;
}

/// Two drums of radius 0.5 and height 0.5 m, joined by a neck of radius `neck` 1 m long.
inline SurfaceMesh dumbbell(double neck) {
  return turned({{0, 0}, {0.5, 0}, {0.5, 0.5}, {neck, 0.5}, {neck, 1.5}, {0.5, 1.5}, {0.5, 2}, {0, 2}}, 16);
}

/// A disc of radius 1 m, `thickness` thick, with a boss of radius 0.3 and height 0.6 m in its middle.
inline SurfaceMesh plateWithBoss(double thickness) {
  return turned({{0, 0}, {1, 0}, {1, thickness}, {0.3, thickness}, {0.3, 0.6}, {0, 0.6}}, 24);
}

/// By the divergence theorem.
inline double volumeOf(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return sum;
}

/// `count` elements, the rest as in the defaults.
inline CookOptions optionsFor(std::size_t count) {
  CookOptions options;
  options.elements = count;
  return options;
}

/// The wall of the paper's figure 6.
inline SurfaceMesh wallMesh() {
  return boxMesh({1, 1, 0.08});
}
inline CookOptions wallOptions() {
  CookOptions options;
  options.elements = 2048;
  options.radius = 0.016;
  options.anchorDirection = -Eigen::Vector3d::UnitY();
  return options;
}

inline std::string fileBytes(const std::filesystem::path& file) {
  std::string bytes(std::filesystem::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), std::streamsize(bytes.size()));
  return bytes;
}

}  // namespace rubble::test
