// Base, shaft and capital are one surface, not three solids that touch: elements are joined across the two
// borders as everywhere else. Around the shaft the square faces are cut into a fan a corner:
//
//     C3------C0      each corner sees a quarter of the circle, and each side of the square
//      | .**. |       the one vertex of the circle that is nearest to it
//      | *  * |
//      | '**' |
//     C2------C1
#include "demo/column_mesh.h"

#include <cmath>
#include <numbers>

namespace rubble::demo {
namespace {

constexpr std::uint32_t kCorners = 4;

class ColumnBuilder {
 public:
  explicit ColumnBuilder(const ColumnForm& form) : m_form(form) {
    const double top = form.size.y() / 2, shaftTop = top - form.plinth;
    const std::uint32_t ground = addSquare(-top), baseTop = addSquare(-shaftTop);
    const std::uint32_t foot = addCircle(-shaftTop), head = addCircle(shaftTop);
    const std::uint32_t capital = addSquare(shaftTop), roof = addSquare(top);
    addQuad(ground, ground + 3, ground + 2, ground + 1);
    addWalls(ground, baseTop, kCorners);
    addCollar(baseTop, foot, true);
    addWalls(foot, head, form.segments);
    addCollar(capital, head, false);
    addWalls(capital, roof, kCorners);
    addQuad(roof, roof + 1, roof + 2, roof + 3);
  }
  SurfaceMesh take() && { return std::move(m_mesh); }

 private:
  // Corners and vertices of circles go counter-clockwise seen from above, from +z to +x: C0 is at +x, +z.
  std::uint32_t addSquare(double height) {
    const auto first = std::uint32_t(m_mesh.vertices.size());
    const double x = m_form.size.x() / 2, z = m_form.size.z() / 2;
    for (const auto& [signX, signZ] : {std::pair(1, 1), {1, -1}, {-1, -1}, {-1, 1}})
      m_mesh.vertices.emplace_back(signX * x, height, signZ * z);
    return first;
  }
  std::uint32_t addCircle(double height) {
    const auto first = std::uint32_t(m_mesh.vertices.size());
    for (std::uint32_t k = 0; k < m_form.segments; ++k) {
      const double angle = 2 * std::numbers::pi * k / m_form.segments;
      m_mesh.vertices.emplace_back(m_form.shaft / 2 * std::sin(angle), height,
                                   m_form.shaft / 2 * std::cos(angle));
    }
    return first;
  }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool up = true) {
    if (up) {
      m_mesh.triangles.push_back({a, b, c});
    } else {
      m_mesh.triangles.push_back({a, c, b});
    }
  }
  void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
  }
  void addWalls(std::uint32_t lower, std::uint32_t upper, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t next = (k + 1) % count;
      addQuad(lower + k, lower + next, upper + next, upper + k);
    }
  }
  // The square without the circle, seen from above (`up`) or from below.
  void addCollar(std::uint32_t square, std::uint32_t circle, bool up) {
    const std::uint32_t quarter = m_form.segments / kCorners;
    for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
      const std::uint32_t start = corner * quarter;
      const auto vertex = [&](std::uint32_t k) { return circle + (start + k) % m_form.segments; };
      for (std::uint32_t k = 0; k < quarter; ++k) addTriangle(square + corner, vertex(k + 1), vertex(k), up);
      const std::uint32_t before = (corner + kCorners - 1) % kCorners;
      addTriangle(square + before, square + corner, vertex(0), up);
    }
  }

  const ColumnForm& m_form;
  SurfaceMesh m_mesh;
};

}  // namespace

SurfaceMesh columnMesh(const ColumnForm& form) {
  return ColumnBuilder(form).take();
}

}  // namespace rubble::demo
