#include "render/shapes.h"

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <utility>

namespace rubble::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct UnitSphere {
  std::vector<Eigen::Vector3f> points;
  std::vector<Triangle> triangles;
};

// Vertices (0, +-1, +-golden) and their rotations, the classical construction.
UnitSphere icosahedron() {
  const float g = std::numbers::phi_v<float>;
  UnitSphere s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3f& p : s.points) p.normalize();
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return s;
}

void split(UnitSphere& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), std::uint32_t(s.points.size()));
    if (isNew) s.points.push_back(Eigen::Vector3f(s.points[a] + s.points[b]).normalized());
    return it->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : s.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  s.triangles = std::move(finer);
}

}  // namespace

Shape sphereShape(float radius, int levels) {
  UnitSphere s = icosahedron();
  for (int i = 0; i < levels; ++i) split(s);
  Shape shape;
  for (const Eigen::Vector3f& p : s.points) shape.vertices.push_back({p * radius, p});
  shape.triangles = std::move(s.triangles);
  return shape;
}

Shape flatShape(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles) {
  Shape shape;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3f normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    if (!(normal.squaredNorm() > 0)) continue;
    const auto first = std::uint32_t(shape.vertices.size());
    for (const std::uint32_t v : {a, b, c}) shape.vertices.push_back({vertices[v], normal.normalized()});
    shape.triangles.push_back({first, first + 1, first + 2});
  }
  return shape;
}

Shape boxShape(const Eigen::Vector3f& halfExtents) {
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(halfExtents.cwiseProduct(
        Eigen::Vector3f(i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f)));
  }
  const std::array<Triangle, 12> triangles{{{0, 2, 3},
                                            {0, 3, 1},
                                            {4, 5, 7},
                                            {4, 7, 6},
                                            {0, 1, 5},
                                            {0, 5, 4},
                                            {2, 6, 7},
                                            {2, 7, 3},
                                            {0, 4, 6},
                                            {0, 6, 2},
                                            {1, 3, 7},
                                            {1, 7, 5}}};
  return flatShape(corners, triangles);
}

}  // namespace rubble::render
