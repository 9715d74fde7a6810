// What the cook makes, to the last bit, in every build: caches of assets rely on it. A change that is meant
// to change it changes the hash; this prints the one to put into rubble/version.h.
#include <gtest/gtest.h>

#include <cmath>
#include <ios>

#include "base/hash.h"
#include "bench/asset_hash.h"
#include "rubble/version.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

// Vertices on a grid of a micrometre: what library functions round, the last bit, does not show.
SurfaceMesh onMicrometres(SurfaceMesh mesh) {
  constexpr double kSteps = 1 << 20;  // a metre
  for (Eigen::Vector3d& vertex : mesh.vertices)
    for (double& x : vertex) x = std::round(x * kSteps) / kSteps;
  return mesh;
}

// With all that a file may say of its look.
SurfaceMesh paintedBox() {
  SurfaceMesh mesh = boxMesh({1, 2, 1});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.normals.push_back({Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(1, 0, 0)});
    mesh.uvs.push_back({Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 0), Eigen::Vector2f(0, float(t))});
    mesh.materials.push_back(std::uint16_t(t % 2));
  }
  mesh.materialNames = {"stone", "paint"};
  return mesh;
}

SurfaceMesh farBox() {
  return boxMesh({1, 1, 0.5}, {500'000, 0, 6'000'000});
}

// Boxes and others, whose distances are found in two ways; cavities, thin walls and parts, gaps; a radius
// that is given and one that is chosen; an origin of its own; anchors; looks.
std::uint64_t cookedHash() {
  CookOptions usual = optionsFor(64), anchored = usual, given = usual;
  anchored.anchorDirection = -Eigen::Vector3d::UnitY();
  given.radius = 0.02;
  given.elements = 0;
  base::Fnv1a hash;
  const auto add = [&hash](const SurfaceMesh& mesh, const CookOptions& options) {
    addAsset(hash, cook(onMicrometres(mesh), options));
  };
  add(wallMesh(), anchored);
  add(wallMesh(), given);
  add(ell(), anchored);
  add(torus(1, 0.3, 32, 16), usual);
  add(hollowCube(), usual);
  add(tilted(shell()), usual);
  add(table(0.05, 0.05), usual);
  add(cup(), optionsFor(512));
  add(slottedSlab(0.01), usual);
  add(plateAndCube(0.02), usual);
  add(farBox(), usual);
  add(paintedBox(), anchored);
  return hash.value();
}

TEST(CookVersion, IsThatOfWhatIsCookedNow) {
  EXPECT_EQ(cookedHash(), kCookVersion)
      << "what is cooked has changed, kCookVersion in rubble/version.h: 0x" << std::hex << cookedHash();
}

}  // namespace
}  // namespace rubble::test
