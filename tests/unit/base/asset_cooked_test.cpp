// What the cook makes is never refused, and has its corners where the mesh has them: solids of all kinds,
// from a millimetre to a kilometre, far from the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct Solid {
  const char* name;
  SurfaceMesh mesh;
  std::size_t elements;
};

std::vector<Solid> solids() {
  return {{"cube", boxMesh({1, 1, 1}), 1},
          {"cube", boxMesh({1, 1, 1}), 2},
          {"cube", boxMesh({1, 1, 1}), 150},
          {"plate", boxMesh({1, 1, 0.02}), 60},
          {"rod", boxMesh({0.01, 1, 0.01}), 30},
          {"L", ell(), 40},
          {"slot", you(0.01), 100},
          {"torus", torus(1, 0.3, 24, 12), 80},
          {"ball", ball(1, 12), 1},
          {"ball", ball(1, 12), 40},
          {"hollow cube", hollowCube(), 60},
          {"two cubes", joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {3, 0, 0})), 40}};
}

// Of a corner of the mesh, from the nearest of the asset's [m].
double farthestMiss(const SurfaceMesh& mesh, const Asset& asset) {
  double farthest = 0;
  for (const Eigen::Vector3d& corner : mesh.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const CellVertex& vertex : asset.vertices)
      nearest = std::min(nearest, (vertex.position.cast<double>() + asset.origin - corner).squaredNorm());
    farthest = std::max(farthest, std::sqrt(nearest));
  }
  return farthest;
}

SurfaceMesh placed(SurfaceMesh mesh, double scale, const Eigen::Vector3d& at) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = scale * vertex + at;
  return mesh;
}

#ifdef RUBBLE_SANITIZED  // the same code at every scale and place
const std::vector<double> kScales = {1e-3};
const std::vector<double> kPlaces = {1e4};
#else
const std::vector<double> kScales = {1e-3, 1, 1e3};
const std::vector<double> kPlaces = {0, 1e4, 1e6};
#endif

TEST(CookedAsset, IsValidAtEveryScaleAndPlace) {
  for (const Solid& solid : solids())
    for (const double scale : kScales)
      for (const double away : kPlaces)
        for (const double least : {0.02, 0.0}) {
          CookOptions options = optionsFor(solid.elements);
          options.minFaceArea = least;
          options.anchorDirection = -Eigen::Vector3d::UnitY();
          options.anchorBand = 1e-6 * scale + 1e-15 * away;
          SCOPED_TRACE(std::string(solid.name) + " x " + std::to_string(scale) + " at " +
                       std::to_string(away));
          try {
            const SurfaceMesh mesh = placed(solid.mesh, scale, away * Eigen::Vector3d(1, -0.3, 0.2));
            const Asset asset = cook(mesh, options);
            EXPECT_EQ(asset.elementCount(), solid.elements);
            // Floats' rounding of a coordinate is 2^-24 of it. Allowed is 5e-5 of the spacing, or that of a
            // solid about its own middle; beside the doubles of the mesh.
            const double rounding = std::ldexp(asset.diagonal(), -23) + std::ldexp(away, -51);
            EXPECT_LE(farthestMiss(mesh, asset), std::max(5e-5 * asset.spacing(), rounding));
            // At 10 km floats hold most solids of a kilometre.
            if (scale < 1e3 || away != 1e4) {
              EXPECT_EQ(asset.origin.isZero(0), away == 0);
            }
          } catch (const Error& error) {
            ADD_FAILURE() << error.what();
          }
        }
}

}  // namespace
}  // namespace rubble::test
