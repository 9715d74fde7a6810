// Surfaces from files: every format gives the same solid, and what is no surface is refused by name.
#include <gtest/gtest.h>

#include <bit>
#include <numbers>

#include "scenes/scene_file.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using namespace std::string_literals;

// The corner of a cube with edges of 1 along the axes: volume 1/6.
constexpr const char* kObj =
    "# a corner\no corner\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl "
    "stone\n"
    "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 2/1 3/1 4/1\nf -4 -1 -2\nl 1 2\n";
constexpr const char* kOff =
    "OFF\n# a corner\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

double volumeOf(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return sum;
}

// Number of corners that the triangles use.
std::size_t cornersOf(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  std::sort(corners.begin(), corners.end());
  return std::size_t(std::unique(corners.begin(), corners.end()) - corners.begin());
}

template <class Number>
void append(std::string& bytes, Number value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  bytes.append(raw.data(), raw.size());
}

// Every triangle with corners of its own, as the format has them (little-endian, like this machine).
std::string binaryStl(const SurfaceMesh& mesh, std::string header = "exported") {
  header.resize(80, ' ');
  append(header, std::uint32_t(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) append(header, 0.0f);
    for (const std::uint32_t corner : triangle)
      for (const double x : mesh.vertices[corner]) append(header, float(x));
    append(header, std::uint16_t(0));
  }
  return header;
}

std::string asciiStl(const SurfaceMesh& mesh) {
  std::ostringstream text;
  text << "solid thing\n";
  for (const auto& triangle : mesh.triangles) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : triangle)
      text << "vertex " << mesh.vertices[corner].transpose() << '\n';
    text << "endloop\nendfacet\n";
  }
  text << "endsolid thing\n";
  return text.str();
}

class ReadMesh : public testing::Test {
 protected:
  SurfaceMesh read(const std::string& name, const std::string& text, double scale = 1) {
    return readMesh(m_folder.write(name, text), scale);
  }
  void expectError(const std::string& name, const std::string& text, const std::string& words) {
    const std::string file = m_folder.write(name, text);
    try {
      readMesh(file);
      FAIL() << "no error; expected: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find(file + ": "), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  void expectCorner(const SurfaceMesh& mesh) {
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(cornersOf(mesh), 4u);
    EXPECT_DOUBLE_EQ(volumeOf(mesh), 1.0 / 6);
  }

  TestFolder m_folder;
};

TEST_F(ReadMesh, TakesTheSameSolidFromEveryFormat) {
  const SurfaceMesh corner = read("corner.obj", kObj);
  expectCorner(corner);
  expectCorner(read("corner.OFF", kOff));
  expectCorner(read("corner.ply", kPly));
  expectCorner(read("binary.stl", binaryStl(corner)));
  expectCorner(read("named.stl", binaryStl(corner, "solid, says the header of a binary file")));
  expectCorner(read("text.stl", asciiStl(corner)));
}

TEST_F(ReadMesh, TakesObjWithTabsLineEndsOfWindowsAndContinuedLines) {
  expectCorner(
      read("corner.obj",
           "v\t0\t0\t0\r\nv +1 0 0\r\n  v 0 1 0 0.5 0.5 0.5\r\nv 0 0 \\\r\n 1\r\nf 1\t3\t2\r\nf 1 2 \\\r\n"
           "4\r\nf 2 3 4\r\nf 1 4 3"));
}

TEST_F(ReadMesh, ScalesToMetres) {
  EXPECT_DOUBLE_EQ(volumeOf(read("corner.off", kOff, 0.5)), 1.0 / 48);
}

TEST_F(ReadMesh, RefusesAScaleThatIsNone) {
  for (const double scale :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(read("corner.off", kOff, scale), Error) << scale;
}

// An L extruded: its two hexagons are not convex, so a fan from their first corner would leave the solid.
TEST_F(ReadMesh, CutsPolygonsThatAreNotConvex) {
  const SurfaceMesh mesh = read("ell.obj",
                                "v 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 .5\nv 1 2 .5\nv "
                                "0 2 .5\nv 0 0 .5\nv 2 0 .5\n"
                                "v 2 1 .5\nf 3 2 1 6 5 4\nf 8 9 10 11 12 7\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 "
                                "9\nf 4 5 11 10\nf 5 6 12 11\n"
                                "f 6 1 7 12\n");
  EXPECT_EQ(mesh.triangles.size(), 2u * 4 + 6 * 2);
  EXPECT_DOUBLE_EQ(volumeOf(mesh), 1.5);
  // The area of the triangles, not signed: 3 in each hexagon, and 8 x 0.5 around.
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2;
  EXPECT_DOUBLE_EQ(area, 2 * 3 + 8 * 0.5);
}

// Two cubes side by side are two closed surfaces; welded, their common edges would have four triangles.
TEST_F(ReadMesh, LeavesClosedSurfacesThatTouchAsTheyAre) {
  std::string text;
  for (const double x : {0.0, 1.0})
    for (const Eigen::Vector3d& p : boxMesh({1, 1, 1}, {x, 0, 0}).vertices)
      text += "v " + std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
  for (const std::uint32_t first : {1u, 9u})
    for (const auto& [a, b, c] : boxMesh({1, 1, 1}).triangles)
      text += "f " + std::to_string(a + first) + ' ' + std::to_string(b + first) + ' ' +
              std::to_string(c + first) + '\n';
  EXPECT_EQ(cornersOf(read("two.obj", text)), 16u);
}

// Its top corner three times, as exporters write where a texture has a seam.
TEST_F(ReadMesh, JoinsVerticesAtOnePlace) {
  expectCorner(
      read("seam.off",
           "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 1\n-0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 4\n3 0 5 2\n"));
}

TEST_F(ReadMesh, DropsATriangleWithTwoCornersAtOnePlace) {
  expectCorner(read("sliver.off",
                    std::string(kOff).replace(std::string(kOff).find("4 4 0"), 5, "4 5 0") + "3 1 1 2\n"));
}

TEST_F(ReadMesh, LeavesHolesToTheCheckOfCook) {
  const SurfaceMesh mesh =
      read("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_THROW(cook(mesh, {}), Error);
}

TEST_F(ReadMesh, RefusesWhatIsNoMesh) {
  expectError("empty.ply", "", "line 1 of its PLY header is the last");
  for (const char* name : {"empty.obj", "empty.off", "empty.stl"}) expectError(name, "", "holds no faces");
  expectError("text.ply", "not a mesh\n", "line 1 of its PLY header does not start with ply");
  for (const char* name : {"text.obj", "text.off", "text.stl"})
    expectError(name, std::string(3, '\0') + "not a mesh\n", "holds no faces");
  expectError("corner.fbx", kObj, "ends in .fbx; allowed: .obj, .off, .ply and .stl");
  expectError("corner", kObj, "has no ending");
}

TEST_F(ReadMesh, RefusesNumbersThatAreNotFinite) {
  expectError("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "line 2 is no vertex");
  expectError("inf.obj", "v 0 0 0\nv 0 -inf 0\nv 0 1 0\nf 1 2 3\n", "line 2 is no vertex");
  expectError("huge.obj", "v 1e999 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n", "line 1 is no vertex");
  expectError("short.obj", "v 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n", "line 1 is no vertex");
  for (const char* word : {"nan", "-NaN", "inf", "-Infinity", "1e999", "-1.#IND"}) {
    SCOPED_TRACE(word);
    const std::string cause = std::string(" has ") + word + " for a coordinate; allowed: finite numbers";
    expectError("nan.off", std::string("OFF # of nan\n3 1 0\n\n0 0 0\n0 ") + word + " 0\n0 0 1\n3 0 1 2\n",
                "line 5" + cause);
    // Its name and its normals are not looked at.
    expectError("nan.stl",
                std::string("solid nan\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "  vertex\t0 1 ") +
                    word + "\r\nendloop\nendfacet\nendsolid nan\n",
                "line 6" + cause);
  }
  // What else is wrong keeps its own cause.
  expectError("short.off", "OFF\n3 1 0\n0 0 0\n0 1 0\n", "holds no faces");
  SurfaceMesh corner = read("corner.obj", kObj);
  corner.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  expectError("nan.stl", binaryStl(corner), "vertex 1 is not finite");
}

TEST_F(ReadMesh, RefusesFacesThatNameNoVertex) {
  expectError("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
              "face 0 names a vertex that is not there");
  expectError("before.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", "line 4 is no face");
  expectError("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "face 0 has 2 corners; allowed: 3 to 4096");
}

TEST_F(ReadMesh, TakesPlyOfAnyTypes) {
  std::string text = kPly;
  for (const auto& [part, instead] : {std::pair("float x", "int16 x"), std::pair("float z", "uchar z"),
                                      std::pair("uchar int", "int short")})
    text.replace(text.find(part), std::string(part).size(), instead);
  expectCorner(read("types.ply", text));
}

TEST_F(ReadMesh, RefusesPlyFacesThatNameNoVertex) {
  for (const char* corner : {"-1", "0.5", "4294967295", "4"})
    expectError(
        "a.ply",
        std::string(kPly).replace(std::string(kPly).find("3 0 3 2"), 7, std::string("3 0 3 ") + corner),
        "face 3 names a vertex that is not there; allowed: those of the file");
}

// Numbers of items that the file does not hold: no memory is taken for them.
TEST_F(ReadMesh, RefusesCountsThatTheFileDoesNotHold) {
  expectError("vertices.off", "OFF\n100000000000 4 0\n0 0 0\n", "holds no faces");
  expectError("corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "holds no faces");
  expectError("list.ply",
              "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n" +
                  std::string(36, '\0') + "\xff\xff\x0f\0 four items"s,
              "ends before vertex_indices of face 0");
  expectError("long.ply",
              "ply\nformat binary_big_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
              "\xff\xff\xff\xff",
              "vertex_indices of face 0 is a list of 4294967295; allowed: 0 to 1048576");
  expectError(
      "vertices.ply",
      "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 100000000000\nproperty "
      "float x\n"
      "property float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\n"
      "end_header\n0 0 0\n",
      "ends before x of vertex 1");
  expectError("cut.stl", binaryStl(read("corner.obj", kObj)).substr(0, 200),
              "has 200 bytes; its 4 triangles take 284");
}

// Text that counts in 32 bits is read, and so is what other programs add.
TEST_F(ReadMesh, TakesPlyWithMoreThanAMesh) {
  expectCorner(read(
      "more.ply",
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info x\r\nelement vertex 4\r\nproperty uchar red\r\n"
      "property float32 x\r\nproperty float64 y\r\nproperty float z\r\nproperty float green\r\n"
      "element camera 1\r\nproperty int halfedge\r\nelement face 4\r\n"
      "property list uint32 uint vertex_index\r\nproperty list uchar float texcoord\r\nend_header\r\n"
      "9 0 0 0 1\n9 1 0 0 1\n9 0 1 0 1\n9 0 0 1 1\n7\n"
      "3 0 2 1 6 .1 .2 .3 .4 .5 .6\n3 0 1 3 0\n3 1 2 3 0\n3 0 3 2 0\n"));
}

TEST_F(ReadMesh, RefusesPlyHeadersThatAreDamaged) {
  const auto damaged = [](const std::string& part, const std::string& instead) {
    std::string text = kPly;
    return text.replace(text.find(part), part.size(), instead);
  };
  expectError("a.ply", damaged("element vertex", "elem vertex"),
              "line 3 of its PLY header starts with no keyword");
  expectError("b.ply", damaged("element vertex 4\n", ""),
              "line 3 of its PLY header is a property of nothing");
  expectError("c.ply", damaged("float x", "half x"), "line 4 of its PLY header is no property");
  expectError("d.ply", damaged("uchar int", "float int"), "line 8 of its PLY header is no list");
  expectError("e.ply", damaged("property float z\n", ""), "names no mesh");
  expectError("f.ply", std::string(kPly).substr(0, 60), "a header that ends with end_header");
}

TEST_F(ReadMesh, RefusesFoldersAndFilesThatAreNotThere) {
  const std::filesystem::path folder = m_folder.path() / "folder.obj";
  std::filesystem::create_directory(folder);
  for (const auto& [file, words] : {std::pair(folder, "is a folder; allowed: a mesh file"),
                                    std::pair(m_folder.path() / "none.obj", "no such file")}) {
    try {
      readMesh(file);
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()), file.string() + ": " + words);
    }
  }
}

}  // namespace
}  // namespace rubble::test
