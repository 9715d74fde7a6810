// All elements together weigh, balance and turn as the solid does.
#include <gtest/gtest.h>

#include "cook/balance.h"
#include "cook/polyhedron.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct Moments {
  double volume = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, density 1
};

// As a body's solver adds them up: points with a scalar inertia of their own, by parallel axes.
Moments momentsOf(const Asset& asset) {
  Moments sum;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    sum.volume += asset.volumes[i];
    sum.centre += asset.volumes[i] * asset.positions[i];
  }
  sum.centre /= sum.volume;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const Eigen::Vector3d arm = asset.positions[i] - sum.centre;
    sum.inertia +=
        asset.volumes[i] *
        ((arm.squaredNorm() + asset.gyrations[i]) * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
  return sum;
}

// Textbook: V (b^2 + c^2) / 12 about the axis of a.
Moments boxMoments(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d squares = size.cwiseAbs2();
  const double volume = size.prod();
  const Eigen::Vector3d diagonal = volume / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
  return {volume, centre, diagonal.asDiagonal()};
}

// Parts that do not overlap, added (sign 1) or cut out (-1), by parallel axes.
Moments together(const std::vector<std::pair<double, Moments>>& parts) {
  Moments sum;
  for (const auto& [sign, part] : parts) {
    sum.volume += sign * part.volume;
    sum.centre += sign * part.volume * part.centre;
  }
  sum.centre /= sum.volume;
  for (const auto& [sign, part] : parts) {
    const Eigen::Vector3d arm = part.centre - sum.centre;
    sum.inertia += sign * (part.inertia + part.volume * (arm.squaredNorm() * Eigen::Matrix3d::Identity() -
                                                         arm * arm.transpose()));
  }
  return sum;
}

void expectSame(const Moments& moments, const Moments& wanted, double size, double inertiaTolerance) {
  EXPECT_NEAR(moments.volume, wanted.volume, 1e-9 * wanted.volume);
  EXPECT_LE((moments.centre - wanted.centre).norm(), 1e-9 * size);
  EXPECT_LE((moments.inertia - wanted.inertia).norm(), inertiaTolerance * wanted.inertia.norm());
}

Moments ellMoments() {
  return together(
      {{1, boxMoments({2, 1, 0.5}, {1, 0.5, 0.25})}, {1, boxMoments({1, 1, 0.5}, {0.5, 1.5, 0.25})}});
}

TEST(Balance, PolyhedraHaveTheMomentsOfBoxAndBall) {
  const auto integrate = [](const SurfaceMesh& mesh, const Eigen::Vector3d& origin) {
    cooking::PolyhedronIntegrals integrals(origin);
    for (const auto& [a, b, c] : mesh.triangles)
      integrals.add(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    return integrals;
  };
  const auto box = integrate(boxMesh({1, 2, 3}, {4, 5, 6}), {3, 4, 7});
  EXPECT_NEAR(box.volume(), 6, 1e-12);
  EXPECT_LT((box.centroid() - Eigen::Vector3d(4, 5, 6)).norm(), 1e-12);
  const Eigen::Matrix3d squares = Eigen::Vector3d(1, 4, 9).asDiagonal();
  EXPECT_LT((box.spread() - squares / 12).norm(), 1e-12);
  // R^2 / 5 along each axis; chords of 180 / 128 degrees lie within R (1 - cos 0.7 degrees), 8e-5 R, of it.
  const auto round = integrate(ball(2, 128), {0.5, 0, 0});
  EXPECT_LT((round.spread() - 0.8 * Eigen::Matrix3d::Identity()).norm(), 4e-4);
}

TEST(Balance, ElementsTogetherTurnAsTheSolid) {
  for (const std::size_t count : {64u, 256u, 2048u}) {
    SCOPED_TRACE(count);
    expectSame(momentsOf(cookStrictly(ell(), optionsFor(count))), ellMoments(), 3, 1e-9);
    expectSame(momentsOf(cookStrictly(boxMesh({1, 2, 3}, {5, -3, 2}), optionsFor(count))),
               boxMoments({1, 2, 3}, {5, -3, 2}), 4, 1e-9);
  }
  expectSame(momentsOf(cookStrictly(boxMesh({1, 1, 1}), optionsFor(16))), boxMoments({1, 1, 1}, {0, 0, 0}), 2,
             1e-9);
  expectSame(momentsOf(cookStrictly(wallMesh(), wallOptions())), boxMoments({1, 1, 0.08}, {0, 0, 0}), 1.5,
             1e-9);
}

TEST(Balance, ElementsOfATiltedRingAndATableTurnAsTheyDo) {
  for (const SurfaceMesh& mesh : {tilted(torus(1, 0.3, 48, 24)), tilted(table(0.2, 0.2)), ball(1, 24)}) {
    // Against an origin far off: another sum than the library's.
    cooking::PolyhedronIntegrals solid(Eigen::Vector3d(0.3, -0.7, 0.4));
    for (const auto& [a, b, c] : mesh.triangles)
      solid.add(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    const Eigen::Matrix3d spread = solid.volume() * solid.spread();
    const Moments wanted{solid.volume(), solid.centroid(),
                         spread.trace() * Eigen::Matrix3d::Identity() - spread};
    expectSame(momentsOf(cookStrictly(mesh, optionsFor(256))), wanted, 2, 1e-9);
  }
}

// Cells of the wall have little room beside those of the foot.
TEST(Balance, ACupWithAFootTurnsAsTheSolid) {
  const Moments wanted = together(
      {{1, boxMoments({1, 1, 1}, {0.5, 0.5, 0.5})}, {-1, boxMoments({0.9, 0.7, 0.9}, {0.5, 0.65, 0.5})}});
  for (const std::size_t count : {512u, 2048u}) {
    SCOPED_TRACE(count);
    expectSame(momentsOf(cook(cup(), optionsFor(count))), wanted, 2, 1e-8);
  }
}

// No scalar inertia of elements as wide as a plate, or wider, is that of the plate about every axis, and a
// handful of points spans no space.
TEST(Balance, FewElementsKeepMassAndCentre) {
  for (const std::size_t count : {1u, 2u, 4u, 8u, 16u}) {
    SCOPED_TRACE(count);
    const Asset asset = cook(boxMesh({1, 1, 0.08}, {3, 2, 1}), optionsFor(count));
    const Moments moments = momentsOf(asset);
    EXPECT_NEAR(moments.volume, 0.08, 1e-9 * 0.08);
    EXPECT_LE((moments.centre - Eigen::Vector3d(3, 2, 1)).norm(), 1e-9);
  }
}

// With h the spacing, a cell's own spread along an axis is below h^2 or so, and so is what is wrong with it:
// of the plate's size squared over 12, 12 / n.
TEST(Balance, ThinPlatesTurnAlmostAsTheSolid) {
  for (const std::size_t count : {64u, 256u}) {
    SCOPED_TRACE(count);
    std::string said;
    const Asset asset = cook(boxMesh({1, 1, 0.02}), optionsFor(count), {},
                             [&said](LogLevel, const std::string& text) { said += text; });
    expectSame(momentsOf(asset), boxMoments({1, 1, 0.02}, {0, 0, 0}), 1.5, 12.0 / double(count));
    EXPECT_NE(said.find("moments of inertia together are off by"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace rubble::test
