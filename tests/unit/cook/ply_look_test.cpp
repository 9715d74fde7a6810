// Normals and texture coordinates of PLY files: those of an OBJ file of the same mesh, whatever the bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "scenes/scene_file.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct PlyColumn {
  std::string type, name;  // of the header
};

// Lists are written as uchar and what is in them.
struct PlyText {
  std::vector<PlyColumn> vertex = {{"float", "x"}, {"float", "y"}, {"double", "z"}};
  std::vector<std::vector<double>> vertices;
  std::vector<PlyColumn> face = {{"uint", "vertex_indices"}};
  std::vector<std::vector<std::vector<double>>> faces;  // the lists of each
  bool facesFirst = false;
};

enum class PlyKind { Ascii, Little, Big };

void appendPly(std::string& text, PlyKind kind, const std::string& type, double number) {
  if (kind == PlyKind::Ascii) {
    std::ostringstream out;
    out << number;
    text += out.str() + (text.size() % 7 == 0 ? "\r\n" : " ");
    return;
  }
  const auto put = [&](auto value) {
    auto raw = std::bit_cast<std::array<char, sizeof value>>(value);  // this machine is little-endian
    if (kind == PlyKind::Big) std::reverse(raw.begin(), raw.end());
    text.append(raw.data(), raw.size());
  };
  if (type == "float") return put(float(number));
  if (type == "double") return put(number);
  if (type == "short") return put(std::int16_t(number));
  if (type == "uchar") return put(std::uint8_t(number));
  put(std::uint32_t(number));
}

std::string written(const PlyText& ply, PlyKind kind) {
  const char* format = kind == PlyKind::Ascii    ? "ascii"
                       : kind == PlyKind::Little ? "binary_little_endian"
                                                 : "binary_big_endian";
  std::string text = std::string("ply\nformat ") + format + " 1.0\ncomment TextureFile none.png\n";
  std::string vertices, faces;
  std::string vertexHead = "element vertex " + std::to_string(ply.vertices.size()) + '\n';
  std::string faceHead = "element face " + std::to_string(ply.faces.size()) + '\n';
  for (const PlyColumn& column : ply.vertex)
    vertexHead += "property " + column.type + ' ' + column.name + '\n';
  for (const PlyColumn& column : ply.face)
    faceHead += "property list uchar " + column.type + ' ' + column.name + '\n';
  for (const auto& vertex : ply.vertices)
    for (std::size_t k = 0; k < ply.vertex.size(); ++k)
      appendPly(vertices, kind, ply.vertex[k].type, vertex[k]);
  for (const auto& lists : ply.faces)
    for (std::size_t k = 0; k < ply.face.size(); ++k) {
      appendPly(faces, kind, "uchar", double(lists[k].size()));
      for (const double item : lists[k]) appendPly(faces, kind, ply.face[k].type, item);
    }
  return ply.facesFirst ? text + faceHead + vertexHead + "end_header\n" + faces + vertices
                        : text + vertexHead + faceHead + "end_header\n" + vertices + faces;
}

// A cube whose six squares have four vertices each, of a normal that leans by their number and of texture
// coordinates of their own: every edge is a seam. All numbers are exact in text and in floats.
struct SeamCube {
  std::vector<Eigen::Vector3d> places, normals;
  std::vector<Eigen::Vector2d> uvs;
  std::vector<std::array<std::uint32_t, 4>> squares;

  SeamCube() {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const auto first = std::uint32_t(places.size());
        for (int corner = 0; corner < 4; ++corner) {
          const double a = corner == 1 || corner == 2 ? 1 : -1, b = (corner > 1 ? 1 : -1) * side;
          Eigen::Vector3d place, normal = Eigen::Vector3d::Zero();
          place[axis] = side;
          place[(axis + 1) % 3] = a;
          place[(axis + 2) % 3] = b;
          normal[axis] = 2 * side;
          normal[(axis + 1) % 3] = 0.125 * corner;
          places.push_back(place);
          normals.push_back(normal);
          uvs.emplace_back(0.125 * axis + 0.25 * (a + 1), 0.5 * side + 0.25 * b);
        }
        squares.push_back({first, first + 1, first + 2, first + 3});
      }
  }

  std::string obj(bool hasUvs, bool hasNormals) const {
    std::ostringstream out;
    for (const auto& p : places) out << "v " << p.transpose() << '\n';
    for (const auto& t : uvs)
      if (hasUvs) out << "vt " << t.transpose() << '\n';
    for (const auto& n : normals)
      if (hasNormals) out << "vn " << n.transpose() << '\n';
    for (const auto& square : squares) {
      out << 'f';
      for (const std::uint32_t v : square) {
        const std::string n = std::to_string(v + 1);
        out << ' ' << n << '/' << (hasUvs ? n : "") << '/' << (hasNormals ? n : "");
      }
      out << '\n';
    }
    return out.str();
  }
  PlyText ply(const std::vector<std::string>& uvNames, bool hasNormals) const {
    PlyText text;
    if (hasNormals)
      text.vertex.insert(text.vertex.begin(), {{"float", "nx"}, {"double", "ny"}, {"short", "nz"}});
    text.vertex.push_back({"uchar", "quality"});
    for (const std::string& name : uvNames) text.vertex.push_back({"float", name});
    for (std::size_t v = 0; v < places.size(); ++v) {
      std::vector<double> row;
      if (hasNormals) row = {8 * normals[v].x(), 8 * normals[v].y(), 8 * normals[v].z()};
      row.insert(row.end(), places[v].begin(), places[v].end());
      row.push_back(9);
      for (std::size_t k = 0; k < uvNames.size(); ++k) row.push_back(uvs[v][int(k)]);
      text.vertices.push_back(row);
    }
    for (const auto& square : squares) text.faces.push_back({{square.begin(), square.end()}});
    return text;
  }
};

class PlyLook : public testing::Test {
 protected:
  SurfaceMesh read(const std::string& name, const std::string& text) {
    return readMesh(m_folder.write(name, text));
  }
  SurfaceMesh readObj(bool hasUvs, bool hasNormals) {
    SurfaceMesh mesh = read("cube.obj", m_cube.obj(hasUvs, hasNormals));
    for (auto& normals : mesh.normals)
      for (Eigen::Vector3f& n : normals) n *= 8;  // as the PLY files have them, in whole numbers
    return mesh;
  }
  void expectRefused(const PlyText& text, const std::string& words) {
    expectRefused(written(text, PlyKind::Ascii), words);
  }
  void expectRefused(const std::string& bytes, const std::string& words) {
    try {
      read("damaged.ply", bytes);
      FAIL() << "no error; expected: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("damaged.ply: " + words), std::string::npos) << error.what();
    }
  }
  // The same to the bit, and a closed surface: the doubled vertices at the seams are one.
  void expectSame(const SurfaceMesh& mesh, const SurfaceMesh& as) {
    EXPECT_EQ(mesh.vertices, as.vertices);
    EXPECT_EQ(mesh.triangles, as.triangles);
    EXPECT_EQ(mesh.normals, as.normals);
    EXPECT_EQ(mesh.uvs, as.uvs);
    CookOptions options;
    options.elements = 8;
    const Asset asset = cook(mesh, options), other = cook(as, options);
    EXPECT_NEAR(asset.volume(), 8, 1e-9);  // a cube of 2 m
    EXPECT_EQ(asset.uvs.empty(), as.uvs.empty());
    EXPECT_EQ(asset.uvs, other.uvs);
    EXPECT_EQ(asset.vertices.size(), other.vertices.size());
  }

  static constexpr std::array kKinds = {PlyKind::Ascii, PlyKind::Little, PlyKind::Big};
  SeamCube m_cube;
  TestFolder m_folder;
};

TEST_F(PlyLook, VerticesGiveWhatObjGives) {
  const SurfaceMesh obj = readObj(true, true);
  ASSERT_EQ(obj.normals.size(), 12u);
  ASSERT_EQ(obj.uvs.size(), 12u);
  for (const PlyKind kind : kKinds)
    for (const auto& names :
         std::vector<std::vector<std::string>>{{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}})
      expectSame(read("cube.ply", written(m_cube.ply(names, true), kind)), obj);
}

TEST_F(PlyLook, NormalsAloneAndUvsAlone) {
  for (const PlyKind kind : kKinds) {
    expectSame(read("cube.ply", written(m_cube.ply({}, true), kind)), readObj(false, true));
    expectSame(read("cube.ply", written(m_cube.ply({"s", "t"}, false), kind)), readObj(true, false));
    expectSame(read("cube.ply", written(m_cube.ply({}, false), kind)), readObj(false, false));
  }
}

// As MeshLab writes them; they count before those of the vertices, which a face without a list falls back to.
TEST_F(PlyLook, FacesGiveTheirOwnUvs) {
  PlyText text = m_cube.ply({"s", "t"}, true);
  text.face.push_back({"float", "texcoord"});
  for (std::size_t f = 0; f < text.faces.size(); ++f) {
    std::vector<double>& own = text.faces[f].emplace_back();
    if (f == 2) continue;
    for (const std::uint32_t v : m_cube.squares[f])
      for (int k = 0; k < 2; ++k) {
        own.push_back(m_cube.uvs[v][k]);
        text.vertices[v][std::size_t(7 + k)] = -5;  // of the vertex: not looked at
      }
  }
  for (const PlyKind kind : kKinds)
    for (const bool facesFirst : {false, true}) {
      text.facesFirst = facesFirst;
      expectSame(read("cube.ply", written(text, kind)), readObj(true, true));
    }
}

// One vertex a corner of the cube, no seam in the places, six of the texture coordinates.
TEST_F(PlyLook, FacesGiveUvsToVerticesThatTheyShare) {
  PlyText text = m_cube.ply({}, false);
  std::vector<Eigen::Vector3d> corners;
  text.vertices.clear();
  text.face.push_back({"double", "texcoord"});
  std::string obj;
  std::vector<std::uint32_t> shared;
  for (const Eigen::Vector3d& place : m_cube.places) {
    const auto at = std::find(corners.begin(), corners.end(), place);
    shared.push_back(std::uint32_t(at - corners.begin()));
    if (at != corners.end()) continue;
    corners.push_back(place);
    text.vertices.push_back({place.x(), place.y(), place.z(), 0});
  }
  ASSERT_EQ(corners.size(), 8u);
  std::ostringstream out;
  for (const auto& p : corners) out << "v " << p.transpose() << '\n';
  for (const auto& t : m_cube.uvs) out << "vt " << t.transpose() << '\n';
  for (std::size_t f = 0; f < text.faces.size(); ++f) {
    out << 'f';
    std::vector<double> own;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t v = m_cube.squares[f][k];
      text.faces[f][0][k] = shared[v];
      own.insert(own.end(), m_cube.uvs[v].begin(), m_cube.uvs[v].end());
      out << ' ' << shared[v] + 1 << '/' << v + 1;
    }
    text.faces[f].push_back(own);
    out << '\n';
  }
  for (const PlyKind kind : kKinds)
    expectSame(read("cube.ply", written(text, kind)), read("shared.obj", out.str()));
}

TEST_F(PlyLook, MissingPartsAreNamed) {
  PlyText text = m_cube.ply({"s", "t"}, true);
  text.vertex[1].name = "curvature";
  expectRefused(text,
                "its PLY header names nx, nz of a vertex, but not all of nx, ny, nz; allowed: all or none");
  text = m_cube.ply({"s", "q"}, false);
  expectRefused(text, "its PLY header names s of a vertex, but not all of s, t");
  text = m_cube.ply({"s", "t"}, true);
  text.vertex[1].name = "nx";
  expectRefused(text, "its PLY header names nx, nz of a vertex, but not all");
  text.vertex = m_cube.ply({"s", "t"}, true).vertex;
  text.vertex[6].name = "t";
  expectRefused(text, "its PLY header names t of a vertex twice");
}

TEST_F(PlyLook, DamagedPartsAreNamed) {
  const PlyText whole = m_cube.ply({"s", "t"}, true);
  PlyText text = whole;
  text.vertices[3][0] = std::numeric_limits<double>::quiet_NaN();
  for (const PlyKind kind : kKinds)
    expectRefused(written(text, kind), "a normal of vertex 3 is not finite; allowed");
  text = whole;
  text.vertices[4][8] = std::numeric_limits<double>::infinity();
  for (const PlyKind kind : kKinds)
    expectRefused(written(text, kind), "a texture coordinate of vertex 4 is not finite");
  text = whole;
  text.face.push_back({"float", "texcoord"});
  for (auto& lists : text.faces) lists.push_back({});
  text.faces[5][1] = {0, 0, 1, 0, 1};
  for (const PlyKind kind : kKinds)
    expectRefused(written(text, kind),
                  "texcoord of face 5 has 5 numbers for 4 corners; allowed: none, or two");
  std::string word = written(whole, PlyKind::Ascii);
  const std::size_t body = word.find("end_header\n") + 11;
  expectRefused(word.substr(0, body) + "a" + word.substr(body + 1), "nx of vertex 0 is no number");
  expectRefused(word.substr(0, word.size() - 4), "ends before vertex_indices of face 5");
  const std::string bytes = written(whole, PlyKind::Big);
  expectRefused(bytes.substr(0, bytes.size() - 1), "ends before vertex_indices of face 5");
  expectRefused(bytes.substr(0, bytes.find("end_header\n") + 11 + 2), "ends before nx of vertex 0");
}

}  // namespace
}  // namespace rubble::test
