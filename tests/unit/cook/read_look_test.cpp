// Normals, texture coordinates and materials of OBJ files; what the format says is from the Wavefront
// specification (Object Files, version 3.0): indices count from 1, negative ones back from the last.
#include <gtest/gtest.h>

#include "scenes/scene_file.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr const char* kPlaces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
constexpr const char* kLooks = "vn 0 0 -2\nvn 0 -1 0\nvn 1 1 1\nvt 0 0\nvt .5 1e0\nvt 0.25\nvt 1 2 3\n";

class ReadLook : public testing::Test {
 protected:
  SurfaceMesh read(const std::string& text) { return readMesh(m_folder.write("mesh.obj", text)); }
  void expectError(const std::string& text, const std::string& words) {
    try {
      read(text);
      FAIL() << "no error; expected: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  TestFolder m_folder;
};

TEST_F(ReadLook, TakesEveryFormOfACorner) {
  const SurfaceMesh mesh = read(std::string(kPlaces) + kLooks +
                                "f 1/1/1 3/2/1 2/3/1\nf 1//2 2//2 4//2\nf 2/4 3/-1 4/-4\nf 1 4/ 3//\n");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  ASSERT_EQ(mesh.normals.size(), 4u);
  ASSERT_EQ(mesh.uvs.size(), 4u);
  for (const Eigen::Vector3f& normal : mesh.normals[0]) EXPECT_EQ(normal, Eigen::Vector3f(0, 0, -2));
  EXPECT_EQ(mesh.uvs[0][0], Eigen::Vector2f(0, 0));
  EXPECT_EQ(mesh.uvs[0][1], Eigen::Vector2f(0.5f, 1));
  EXPECT_EQ(mesh.uvs[0][2], Eigen::Vector2f(0.25f, 0));
  for (const Eigen::Vector3f& normal : mesh.normals[1]) EXPECT_EQ(normal, Eigen::Vector3f(0, -1, 0));
  for (const Eigen::Vector2f& uv : mesh.uvs[1]) EXPECT_EQ(uv, Eigen::Vector2f(0, 0));
  EXPECT_EQ(mesh.uvs[2][0], Eigen::Vector2f(1, 2));
  EXPECT_EQ(mesh.uvs[2][1], Eigen::Vector2f(1, 2));
  EXPECT_EQ(mesh.uvs[2][2], Eigen::Vector2f(0, 0));
  for (const Eigen::Vector3f& normal : mesh.normals[3]) EXPECT_TRUE(normal.isZero());
}

TEST_F(ReadLook, KeepsNothingOfAFileThatSaysNothing) {
  const SurfaceMesh mesh = read(std::string(kPlaces) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_TRUE(mesh.materials.empty());
  EXPECT_TRUE(mesh.materialNames.empty());
}

// A face of six corners that is not convex, and texture coordinates that are the places.
TEST_F(ReadLook, GivesTheCornersOfPolygonsTheirOwn) {
  const SurfaceMesh mesh = read(
      "v 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nvt 1 1\nvt 1 2\nvt 0 2\nvt 0 0\nvt 2 0\nvt 2 1\n"
      "f 3/3 2/2 1/1 6/6 5/5 4/4\n");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.uvs[t][k].cast<double>(), mesh.vertices[mesh.triangles[t][k]].head<2>());
}

// A seam: places stand twice, are joined, and the faces keep their sides of it. The face between two corners
// at one place goes, with its texture and material.
TEST_F(ReadLook, KeepsTheSidesOfASeam) {
  const SurfaceMesh mesh = read(std::string(kPlaces) +
                                "v 0 0 1\nvt 0 0\nvt 1 0\nusemtl a\nf 1/1 3/1 2/1\nusemtl b\nf 4/1 5/1 1/1\n"
                                "usemtl c\nf 1/1 2/1 4/1\nf 2/1 3/1 5/2\nf 1/1 5/2 3/1\n");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.uvs[1][2], Eigen::Vector2f(0, 0));
  EXPECT_EQ(mesh.uvs[2][2], Eigen::Vector2f(1, 0));
  EXPECT_EQ(mesh.uvs[3][1], Eigen::Vector2f(1, 0));
  EXPECT_EQ(mesh.materialNames, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(mesh.materials, (std::vector<std::uint16_t>{0, 2, 2, 2}));
}

TEST_F(ReadLook, NamesMaterialsByTheLineBeforeTheFace) {
  const SurfaceMesh mesh =
      read(std::string(kPlaces) +
           "f 1 3 2\nusemtl  old stone \r\nf 1 2 4\nusemtl unused\nusemtl brick\nf 2 3 4\n"
           "usemtl old stone\nf 1 4 3\n");
  EXPECT_EQ(mesh.materialNames, (std::vector<std::string>{"", "old stone", "brick"}));
  EXPECT_EQ(mesh.materials, (std::vector<std::uint16_t>{0, 1, 2, 1}));
}

TEST_F(ReadLook, RefusesWhatIsDamaged) {
  const std::string start = std::string(kPlaces) + kLooks;  // 11 lines
  expectError(start + "vn 0 0\n", "line 12 is no normal; allowed: vn and three finite numbers");
  expectError(start + "vn 0 nan 0\n", "line 12 is no normal");
  expectError(start + "vt 1e99 0\n", "line 12 is no texture coordinates");
  expectError(start + "vt\n", "line 12 is no texture coordinates");
  expectError(start + "f 1/x 2 3\n", "line 12 is no face; allowed: f and corners v, v/vt, v//vn or v/vt/vn");
  for (const char* face : {"f 0 1 2\n", "f 1/0 2 3\n", "f 1//-4 2 3\n", "f 1/1/1/1 2 3\n", "f / 2 3\n",
                           "f 99999999999999999999 1 2\n", "f 1.5 2 3\n"})
    expectError(start + face, "line 12 is no face");
  expectError(start + "f 1/5 2 3\n", "face 0 names a texture coordinate that is not there");
  expectError(start + "f 1//4 2 3\n",
              "face 0 names a normal that is not there; allowed: those of the file, 3");
  expectError(start + "f 5000000000 2 3\n", "face 0 names a vertex that is not there");
  expectError(start + "usemtl " + std::string(256, 'x') + "\n",
              "line 12 is no material; allowed: usemtl and up to");
  expectError(start + "usemtl a\x01\n", "line 12 is no material");
}

TEST_F(ReadLook, RefusesMoreMaterialsThanCanBeNumbered) {
  std::string text = kPlaces;
  for (int m = 0; m < 65535; ++m) text += "usemtl " + std::to_string(m) + "\nf 1 2 3\n";
  expectError(text, "names more materials than are allowed: up to 65534");
}

}  // namespace
}  // namespace rubble::test
