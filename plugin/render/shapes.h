// Triangle meshes of simple shapes, with normals.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubble::render {

struct ShapeVertex {
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f normal;
};
struct Shape {
  std::vector<ShapeVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// An icosahedron whose triangles are split in four `levels` times, on a sphere.
Shape sphereShape(float radius, int levels);
/// Flat-shaded triangles; degenerate ones are left out. Indices must be in range.
Shape flatShape(std::span<const Eigen::Vector3f> vertices,
                std::span<const std::array<std::uint32_t, 3>> triangles);
Shape boxShape(const Eigen::Vector3f& halfExtents);

}  // namespace rubble::render
