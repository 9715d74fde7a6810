// What cells take over from the mesh: its normals, texture coordinates and materials, wherever it was cut.
#include <gtest/gtest.h>

#include <limits>

#include "rubble/triangle_look.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

// Texture coordinates that are linear in the place, so that their values between the corners are known too.
Eigen::Vector2d linearUv(const Eigen::Vector3d& p) {
  return {0.25 + 2 * p.x() - p.y(), p.z() + 0.5 * p.y()};
}

// Each triangle of the box with the side of the box it is on as its material: -x, +x, -y, ...
SurfaceMesh dressedBox() {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.materialNames = {"-x", "+x", "-y", "+y", "-z", "+z"};
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.vertices[a];
    const Eigen::Vector3d normal = (mesh.vertices[b] - p).cross(mesh.vertices[c] - p);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    mesh.materials.push_back(std::uint16_t(2 * axis + (normal[axis] > 0 ? 1 : 0)));
    std::array<Eigen::Vector2f, 3> uvs;
    for (std::size_t k = 0; const std::uint32_t v : {a, b, c})
      uvs[k++] = linearUv(mesh.vertices[v]).cast<float>();
    mesh.uvs.push_back(uvs);
  }
  return mesh;
}

// Calls visit(triangle, outer) for every triangle.
template <class Visit>
void visitTriangles(const Asset& asset, Visit&& visit) {
  for (const Cell& cell : asset.cells)
    for (std::uint32_t t = 0; t < cell.outerTriangles + cell.innerTriangles; ++t)
      visit(cell.firstTriangle + t, t < cell.outerTriangles);
}

Eigen::Vector3f placeOf(const Asset& asset, std::uint32_t corner) {
  return asset.vertices[asset.corners[corner].vertex].position;
}

TEST(SurfaceLook, TextureCoordinatesAreThoseOfThePlaceOnTheMesh) {
  const Asset asset = cookStrictly(dressedBox(), optionsFor(200));
  ASSERT_EQ(asset.uvs.size(), asset.corners.size());
  visitTriangles(asset, [&](std::uint32_t t, bool isOuter) {
    for (const std::uint32_t corner : asset.triangles[t]) {
      const Eigen::Vector3f place = placeOf(asset, corner);
      const Eigen::Vector2f expected = isOuter ? Eigen::Vector2f(linearUv(place.cast<double>()).cast<float>())
                                               : boxUv(place, asset.corners[corner].normal);
      // Place and coordinate are floats of about 1: a few roundings of 6e-8.
      EXPECT_LT((asset.uvs[corner] - expected).norm(), 1e-6f) << "corner " << corner;
    }
  });
}

TEST(SurfaceLook, EveryOuterTriangleHasTheMaterialOfItsSide) {
  const Asset asset = cookStrictly(dressedBox(), optionsFor(200));
  ASSERT_EQ(asset.materials.size(), asset.triangles.size());
  EXPECT_EQ(asset.innerMaterial(), 6u);
  std::array<double, 7> areas{};
  visitTriangles(asset, [&](std::uint32_t t, bool isOuter) {
    const std::uint16_t material = asset.materials[t];
    EXPECT_EQ(material == 6, !isOuter);
    const auto& [a, b, c] = asset.triangles[t];
    const Eigen::Vector3f p = placeOf(asset, a);
    areas[material] += double((placeOf(asset, b) - p).cross(placeOf(asset, c) - p).norm()) / 2;
    if (isOuter) {
      const float side = material % 2 == 0 ? -0.5f : 0.5f;  // exact: the sides of a unit box
      for (const std::uint32_t corner : {a, b, c}) EXPECT_EQ(placeOf(asset, corner)[material / 2], side);
    }
  });
  for (std::size_t side = 0; side < 6; ++side) EXPECT_NEAR(areas[side], 1, 1e-5) << side;
}

// A drum of eight sides: its edges of 45 degrees are sharp without normals, and round with its own.
TEST(SurfaceLook, NormalsAreTheMeshsOwn) {
  SurfaceMesh mesh = turned({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}, 8);
  const auto normalAt = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3f(float(p.x()), float(p.y()), 0);
  };
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3f, 3> normals;
    bool isSide = false;
    for (const std::uint32_t v : triangle)
      isSide = isSide || mesh.vertices[v].z() != mesh.vertices[triangle[0]].z();
    for (std::size_t k = 0; k < 3; ++k)
      normals[k] = isSide ? normalAt(mesh.vertices[triangle[k]]) : Eigen::Vector3f(Eigen::Vector3f::Zero());
    mesh.normals.push_back(normals);
  }
  const Asset asset = cookStrictly(mesh, optionsFor(100));
  std::size_t onSides = 0;
  visitTriangles(asset, [&](std::uint32_t t, bool isOuter) {
    if (!isOuter) return;
    bool isLid = true;
    for (const std::uint32_t corner : asset.triangles[t])
      isLid = isLid && placeOf(asset, corner).z() == placeOf(asset, asset.triangles[t][0]).z();
    for (const std::uint32_t corner : asset.triangles[t]) {
      const Eigen::Vector3f& normal = asset.corners[corner].normal;
      if (isLid) {  // none given: the lid's own
        EXPECT_NEAR(std::abs(normal.z()), 1, 1e-6) << corner;
      } else {
        ++onSides;
        // Along a chord the normals of its ends blend into the direction of the place: both are linear.
        const Eigen::Vector3f place = placeOf(asset, corner);
        const Eigen::Vector3f expected = Eigen::Vector3f(place.x(), place.y(), 0).normalized();
        EXPECT_LT((normal - expected).norm(), 1e-5f) << corner;
      }
    }
  });
  EXPECT_GT(onSides, 100u);
}

TEST(SurfaceLook, OfAMeshWithoutOneNothingIsKept) {
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), optionsFor(30));
  EXPECT_TRUE(asset.uvs.empty());
  EXPECT_TRUE(asset.materials.empty());
  EXPECT_TRUE(asset.materialNames.empty());
  EXPECT_EQ(asset.innerMaterial(), 1u);
}

TEST(SurfaceLook, OneMaterialNeedsNoNumberATriangle) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.materialNames = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  const Asset asset = cookStrictly(mesh, optionsFor(30));
  EXPECT_TRUE(asset.materials.empty());
  EXPECT_EQ(asset.materialNames, mesh.materialNames);
}

TEST(TriangleLooks, TellMaterialAndTextureOfEveryTriangle) {
  for (const SurfaceMesh& mesh : {dressedBox(), boxMesh({1, 1, 1})}) {
    const Asset asset = cookStrictly(mesh, optionsFor(30));
    const std::vector<TriangleLook> looks = triangleLooks(asset);
    ASSERT_EQ(looks.size(), asset.triangles.size());
    visitTriangles(asset, [&](std::uint32_t t, bool isOuter) {
      const std::uint32_t outer = asset.materials.empty() ? 0u : asset.materials[t];
      EXPECT_EQ(looks[t].material, isOuter ? outer : asset.innerMaterial());
      for (std::size_t k = 0; k < 3; ++k) {
        const CellCorner& corner = asset.corners[asset.triangles[t][k]];
        const Eigen::Vector2f expected = asset.uvs.empty() || !isOuter
                                             ? boxUv(asset.vertices[corner.vertex].position, corner.normal)
                                             : asset.uvs[asset.triangles[t][k]];
        EXPECT_EQ(looks[t].uvs[k], expected);
      }
    });
  }
}

// Its two axes and the normal are a right-handed set on all six sides: no side is mirrored.
TEST(BoxUv, IsNotMirroredAndPointsUp) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const Eigen::Vector3f normal = side * Eigen::Vector3f::Unit(axis);
      Eigen::Vector3f u, v;
      for (int along = 0; along < 3; ++along) {
        const Eigen::Vector2f uv = boxUv(Eigen::Vector3f::Unit(along), normal);
        u[along] = uv.x();
        v[along] = uv.y();
      }
      EXPECT_EQ(u.cross(v), normal) << axis << ' ' << side;
      if (axis == 1) continue;
      EXPECT_EQ(v, Eigen::Vector3f(Eigen::Vector3f::UnitY()));
    }
}

void expectRefused(const SurfaceMesh& mesh, const std::string& words) {
  try {
    cook(mesh, optionsFor(30));
    FAIL() << "no error; expected: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(SurfaceLook, ThatIsImpossibleIsRefusedByName) {
  const auto changed = [](auto&& change) {
    SurfaceMesh mesh = dressedBox();
    change(mesh);
    return mesh;
  };
  expectRefused(changed([](SurfaceMesh& m) { m.uvs.pop_back(); }),
                "mesh: 11 sets of texture coordinates for 12 triangles; allowed: none or one a triangle");
  expectRefused(changed([](SurfaceMesh& m) { m.uvs[3][1].x() = std::numeric_limits<float>::quiet_NaN(); }),
                "mesh: texture coordinates of triangle 3 are not finite");
  expectRefused(changed([](SurfaceMesh& m) { m.normals.resize(13); }), "mesh: 13 sets of normals");
  expectRefused(changed([](SurfaceMesh& m) {
                  m.normals.assign(12, {Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitX(),
                                        Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity())});
                }),
                "mesh: normals of triangle 0 are not finite");
  expectRefused(changed([](SurfaceMesh& m) { m.materials[5] = 6; }),
                "mesh: triangle 5 has material 6; allowed: those that have a name, 6");
  expectRefused(changed([](SurfaceMesh& m) { m.materialNames[2] = "a\nb"; }),
                "the name of material 2 is none");
  expectRefused(changed([](SurfaceMesh& m) { m.materialNames.resize(65535); }),
                "65535 materials; allowed: up to");
}

}  // namespace
}  // namespace rubble::test
