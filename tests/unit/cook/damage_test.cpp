// Repair of solids damaged at random: it ends, and what it makes is right, or told of.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "rubble/repair.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using RepairDamage = testing::Test;

#ifdef RUBBLE_SANITIZED
constexpr int kDamaged = 40;
#else
constexpr int kDamaged = 600;
#endif

class Damage {
 public:
  Damage(SurfaceMesh& mesh, std::mt19937& random) : m_mesh(mesh), m_random(random) {}

  void flip() {
    auto& triangle = m_mesh.triangles[anyTriangle()];
    std::swap(triangle[1], triangle[2]);
  }
  void duplicate() {
    auto copy = m_mesh.triangles[anyTriangle()];
    if (m_random() % 2 == 0) std::swap(copy[1], copy[2]);
    m_mesh.triangles.push_back(copy);
  }
  void splitVertex() {
    std::uint32_t& corner = m_mesh.triangles[anyTriangle()][m_random() % 3];
    m_mesh.vertices.push_back(Eigen::Vector3d(m_mesh.vertices[corner]));
    corner = std::uint32_t(m_mesh.vertices.size() - 1);
  }
  void remove() { m_mesh.triangles.erase(m_mesh.triangles.begin() + std::ptrdiff_t(anyTriangle())); }
  // Cuts a triangle at one of its sides, and not the one beyond.
  void cutAtSide() {
    const std::size_t t = anyTriangle();
    const std::size_t k = m_random() % 3;
    auto& triangle = m_mesh.triangles[t];
    auto other = triangle;
    const auto middle = std::uint32_t(m_mesh.vertices.size());
    m_mesh.vertices.push_back((m_mesh.vertices[triangle[k]] + m_mesh.vertices[triangle[(k + 1) % 3]]) / 2);
    triangle[(k + 1) % 3] = middle;
    other[k] = middle;
    m_mesh.triangles.push_back(other);
  }
  void move() { m_mesh.vertices[m_random() % m_mesh.vertices.size()] *= 1.5; }
  void spoil() {
    m_mesh.vertices[m_mesh.triangles[anyTriangle()][0]].y() = std::numeric_limits<double>::quiet_NaN();
  }

  void any(std::size_t kind) {
    switch (kind) {
      case 0:
        return flip();
      case 1:
        return duplicate();
      case 2:
        return splitVertex();
      case 3:
        return cutAtSide();
      case 4:
        return move();
      default:
        return remove();
    }
  }

 private:
  std::size_t anyTriangle() { return m_random() % m_mesh.triangles.size(); }

  SurfaceMesh& m_mesh;
  std::mt19937& m_random;
};

SurfaceMesh anySolid(std::mt19937& random) {
  switch (random() % 4) {
    case 0:
      return boxMesh({1, 2, 3});
    case 1:
      return ball(1, 8);
    case 2:
      return hollowCube();
    default:
      return torus(1, 0.4, 12, 8);
  }
}

// What `repair` says is well passes the check of `cook`.
void expectBounded(const RepairedMesh& repaired, std::size_t given, int seed) {
  EXPECT_LT(repaired.mesh.triangles.size(), 20 * given + 100) << seed;
  for (const auto& triangle : repaired.mesh.triangles)
    for (const std::uint32_t v : triangle) ASSERT_LT(v, repaired.mesh.vertices.size()) << seed;
  if (repaired.fault.empty()) {
    EXPECT_GT(volumeOf(repaired.mesh), 0) << seed;
  }
}

// Nothing of the surface is gone, only torn and turned, or turned and doubled.
TEST(RepairDamage, OfTornTurnedOrDoubledTrianglesIsUndone) {
  for (int seed = 0; seed < kDamaged; ++seed) {
    std::mt19937 random{std::uint32_t(seed)};
    const SurfaceMesh whole = anySolid(random);
    SurfaceMesh mesh = whole;
    Damage damage(mesh, random);
    for (std::size_t k = random() % 5; k > 0; --k) damage.flip();
    if (seed % 2 == 0) {
      for (std::size_t k = random() % 5; k > 0; --k) damage.cutAtSide();
      for (std::size_t k = random() % 30; k > 0; --k) damage.splitVertex();
    } else {  // a triangle and a piece of its copy would be another matter
      for (std::size_t k = random() % 5; k > 0; --k) damage.duplicate();
    }
    const RepairedMesh repaired = repair(mesh);
    expectBounded(repaired, mesh.triangles.size(), seed);
    EXPECT_EQ(repaired.fault, "") << seed;
    EXPECT_EQ(repaired.left, std::vector<std::string>()) << seed;
    EXPECT_NEAR(volumeOf(repaired.mesh), volumeOf(whole), 1e-9 * volumeOf(whole)) << seed;
  }
}

TEST(RepairDamage, OfAnyKindEnds) {
  for (int seed = 0; seed < kDamaged / 4; ++seed) {
    std::mt19937 random{std::uint32_t(seed)};
    SurfaceMesh mesh = joined(anySolid(random), anySolid(random));
    Damage damage(mesh, random);
    for (std::size_t k = random() % 12; k > 0; --k) damage.any(random() % 6);
    expectBounded(repair(mesh), mesh.triangles.size(), seed);
    damage.spoil();
    EXPECT_THROW(repair(mesh), Error) << seed;
  }
}

}  // namespace
}  // namespace rubble::test
