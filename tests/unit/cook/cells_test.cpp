// Cells of cooked solids, through the public interface.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "support/strict_cook.h"
#include "unit/cook/packed.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct CellsCase {
  const char* name;
  SurfaceMesh mesh;
  std::size_t elements;
  bool shrinks = false;  // elements of the default fill do not fit, and cook() warns of that
};

std::vector<CellsCase> cellsCases() {
  return {{"Box", boxMesh({1, 1, 0.08}), 300},
          {"L", ell(), 300},
          {"U", you(0.5), 300},
          {"Slot", you(0.01), 400},
          {"SlottedSlab", slottedSlab(0.01), 300},
          {"Torus", torus(1, 0.3, 48, 24), 300},
          {"Ball", ball(1, 16), 200},
          {"HollowCube", hollowCube(), 300},
          {"TwoBoxes", joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {3, 0, 0})), 100},
          {"HollowCubeOfOneElement", hollowCube(), 1, true},
          {"TorusOfTwoElements", torus(1, 0.3, 24, 12), 2, true}};
}

class Cells : public testing::TestWithParam<std::size_t> {
 protected:
  Cells()
      : m_case(cellsCases()[GetParam()]),
        m_asset(cook(m_case.mesh, optionsFor(m_case.elements), {}, m_warnings.log())) {
    EXPECT_EQ(m_warnings.take("do not fit; radius"), m_case.shrinks ? 1 : 0);
    if (m_case.shrinks) m_warnings.take("are thinner than the elements");
  }

  std::array<std::uint32_t, 3> vertexIds(std::size_t triangle) const {
    std::array<std::uint32_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) ids[k] = m_asset.corners[m_asset.triangles[triangle][k]].vertex;
    return ids;
  }
  std::size_t triangleCount(const Cell& cell) const { return cell.outerTriangles + cell.innerTriangles; }

  ExpectedWarnings m_warnings;
  const CellsCase m_case;
  const Asset m_asset;
};

TEST_P(Cells, AreAsManyAsAsked) {
  EXPECT_EQ(m_asset.elementCount(), m_case.elements);
  EXPECT_EQ(m_asset.cells.size(), m_case.elements);
}

TEST_P(Cells, AreClosed) {
  for (const Cell& cell : m_asset.cells) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < triangleCount(cell); ++t) {
      const auto ids = vertexIds(cell.firstTriangle + t);
      for (std::size_t k = 0; k < 3; ++k) ++edges[{ids[k], ids[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
  }
}

// Rounding alone: the sum telescopes to the surface's own integral.
TEST_P(Cells, VolumesAddUpToTheSolid) {
  const double expected = volumeOf(m_case.mesh);
  EXPECT_NEAR(m_asset.volume(), expected, 1e-9 * expected);
}

// From the float vertices, so to a few float roundings of the solid's size.
TEST_P(Cells, VolumesAreThoseOfTheirMeshes) {
  const double tolerance = 1e-6 * std::pow(m_asset.diagonal(), 3);
  for (std::size_t i = 0; i < m_asset.elementCount(); ++i) {
    double sum = 0;
    for (std::size_t t = 0; t < triangleCount(m_asset.cells[i]); ++t) {
      std::array<Eigen::Vector3d, 3> p;
      const auto ids = vertexIds(m_asset.cells[i].firstTriangle + t);
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = m_asset.vertices[ids[k]].position.cast<double>() - m_asset.positions[i];
      sum += p[0].dot(p[1].cross(p[2])) / 6;
    }
    EXPECT_NEAR(sum, m_asset.volumes[i], tolerance);
  }
}

// A vertex lists exactly the cells that use it: so neighbours name the same place by the same id, and none is
// missed.
TEST_P(Cells, ShareTheirVertices) {
  std::vector<std::set<std::uint32_t>> users(m_asset.vertices.size());
  for (const CellCorner& corner : m_asset.corners) users[corner.vertex].insert(corner.element);
  for (std::size_t v = 0; v < users.size(); ++v) {
    std::set<std::uint32_t> listed(m_asset.vertices[v].elements.begin(), m_asset.vertices[v].elements.end());
    listed.erase(kNoElement);
    ASSERT_EQ(users[v], listed) << "vertex " << v;
  }
}

TEST_P(Cells, OuterTrianglesCoverTheSurface) {
  double expected = 0;
  for (const auto& [a, b, c] : m_case.mesh.triangles)
    expected += (m_case.mesh.vertices[b] - m_case.mesh.vertices[a])
                    .cross(m_case.mesh.vertices[c] - m_case.mesh.vertices[a])
                    .norm() /
                2;
  double faces = 0;
  for (const CellFace& face : m_asset.faces)
    if (face.neighbour == kNoElement) faces += double(face.area);
  EXPECT_NEAR(faces, expected, 1e-5 * expected);  // areas are floats
}

// Newton's third law needs both cells to have the face, with the same area and opposite normals.
TEST_P(Cells, HaveEachInnerFaceTwice) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, const CellFace*> faces;
  for (std::uint32_t i = 0; i < m_asset.elementCount(); ++i)
    for (const CellFace& face : m_asset.cellFaces(i))
      if (face.neighbour != kNoElement) {
        ASSERT_TRUE(faces.emplace(std::pair(i, face.neighbour), &face).second);
      }
  for (const auto& [pair, face] : faces) {
    const auto opposite = faces.find({pair.second, pair.first});
    ASSERT_NE(opposite, faces.end());
    EXPECT_NEAR(face->area, opposite->second->area, 1e-6f * float(m_asset.spacing() * m_asset.spacing()));
    EXPECT_LT((face->normal + opposite->second->normal).norm(), 1e-6f);
  }
}

// A closed surface has no net area (divergence theorem for a constant field).
TEST_P(Cells, FaceAreasCancel) {
  // A curved patch keeps the length of its area vectors, whose sum is shorter by 1 - cos 30 degrees at most.
  const double curvature = m_case.mesh.triangles.size() > 100 ? 1 - std::cos(std::numbers::pi / 6) : 0;
  for (std::uint32_t i = 0; i < m_asset.elementCount(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0;
    double outer = 0;
    for (const CellFace& face : m_asset.cellFaces(i)) {
      sum += (face.area * face.normal).cast<double>();
      total += double(face.area);
      if (face.neighbour == kNoElement) outer += double(face.area);
    }
    // The caps' normals are those of the bisectors, right to the sites' jitter of 1e-6 r.
    EXPECT_LT(sum.norm(), 1e-4 * total + curvature * outer) << "cell " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, Cells, testing::Range<std::size_t>(0, cellsCases().size()),
                         [](const auto& solid) { return std::string(cellsCases()[solid.param].name); });

// Oracle: random points belong to their nearest element. Binomial statistics, five standard deviations.
TEST(Cells, VolumesAreThoseOfTheNearestElement) {
  const Asset asset = cookStrictly(ell(), optionsFor(40));
  const std::vector<Eigen::Vector3d> sites = pack(ell(), optionsFor(40)).centres;
  ASSERT_EQ(sites.size(), asset.elementCount());
  constexpr int kSamples = 100000;
  std::vector<int> hits(asset.elementCount(), 0);
  std::mt19937_64 generator(7);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  for (int inside = 0; inside < kSamples;) {
    const Eigen::Vector3d p(2 * uniform(), 2 * uniform(), 0.5 * uniform());
    if (p.x() > 1 && p.y() > 1) continue;
    ++inside;
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < asset.elementCount(); ++i)
      if ((sites[i] - p).squaredNorm() < (sites[nearest] - p).squaredNorm()) nearest = i;
    ++hits[nearest];
  }
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const double share = asset.volumes[i] / asset.volume();
    const double deviation = std::sqrt(kSamples * share * (1 - share));
    EXPECT_NEAR(hits[i], kSamples * share, 5 * deviation) << "element " << i;
  }
}

// The inertia of a cube is m h^2 / 6 about each axis.
TEST(Cells, GyrationOfACubeIsASixthOfItsEdgeSquared) {
  const double edge = 0.7;
  const Asset asset = cookStrictly(boxMesh(Eigen::Vector3d::Constant(edge), {5, -3, 2}), optionsFor(1));
  EXPECT_NEAR(asset.gyrations[0], edge * edge / 6, 1e-12);
  EXPECT_NEAR(asset.volumes[0], edge * edge * edge, 1e-12);
}

TEST(Cells, OfABoxAreDrawnWithTheSixFlatNormals) {
  const Asset asset = cookStrictly(boxMesh({1, 2, 3}), optionsFor(50));
  for (const Cell& cell : asset.cells)
    for (std::size_t t = cell.firstTriangle; t < cell.firstTriangle + cell.outerTriangles; ++t)
      for (const std::uint32_t corner : asset.triangles[t])
        EXPECT_FLOAT_EQ(asset.corners[corner].normal.cwiseAbs().maxCoeff(), 1.0f);
}

// Vertices lie on the unit sphere, and bands of 180 / 32 degrees are smoothed: the interpolated normal is
// radial to about half the square of that angle.
TEST(Cells, OfABallAreDrawnWithSmoothNormals) {
  const Asset asset = cookStrictly(ball(1, 32), optionsFor(60));
  for (const Cell& cell : asset.cells)
    for (std::size_t t = cell.firstTriangle; t < cell.firstTriangle + cell.outerTriangles; ++t)
      for (const std::uint32_t c : asset.triangles[t]) {
        const CellCorner& corner = asset.corners[c];
        EXPECT_GT(corner.normal.dot(asset.vertices[corner.vertex].position.normalized()), 0.995f);
      }
}

TEST(Cells, HaveOnePatchForEachSideOfTheSolid) {
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), optionsFor(1));
  ASSERT_EQ(asset.faces.size(), 6u);
  for (const CellFace& face : asset.faces) {
    EXPECT_EQ(face.neighbour, kNoElement);
    EXPECT_FLOAT_EQ(face.area, 1.0f);
    EXPECT_NEAR(face.centroid.dot(face.normal), 0.5f, 1e-6f);
  }
}

}  // namespace
}  // namespace rubble::test
