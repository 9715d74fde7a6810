// A mesh file into triangles: read, check the indices, weld what is open, cut polygons.
#include <Eigen/Geometry>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <numeric>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/input_file.h"
#include "base/number_text.h"
#include "cook/obj_file.h"
#include "cook/ply_file.h"
#include "cook/polygon_file.h"
#include "cook/stl_file.h"
#include "cook/triangulation.h"
#include "rubble/cook.h"

namespace rubble {
namespace {

using namespace cooking;

constexpr std::uint64_t kMostBytes = std::uint64_t(4) << 30;  // some 50 million triangles

// Ear clipping takes a second for so many corners.
constexpr std::size_t kMostCorners = 4096;

PolygonSoup parseOff(std::string bytes) {
  return parsePolygons(std::move(bytes), PolygonFormat::Off);
}

PolygonSoup parseStl(std::string bytes) {
  if (auto soup = parseBinaryStl(bytes)) return *std::move(soup);
  return parsePolygons(std::move(bytes), PolygonFormat::Stl);
}

struct Ending {
  const char* text;
  PolygonSoup (*parse)(std::string bytes);
  const char* name;
};
constexpr std::array<Ending, 4> kEndings = {
    {{".obj", [](std::string bytes) { return parseObj(bytes); }, "OBJ"},
     {".off", parseOff, "OFF"},
     {".ply", [](std::string bytes) { return parsePly(bytes); }, "PLY"},
     {".stl", parseStl, "STL"}}};

const Ending& endingOf(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  for (const Ending& ending : kEndings)
    if (text == ending.text) return ending;
  base::refuseFile(file, (text.empty() ? "has no ending" : "ends in " + text) +
                             "; allowed: .obj, .off, .ply and .stl, which name the format");
}

std::string bytesOf(const std::filesystem::path& file) {
  const std::uint64_t size = base::inputSize(file, "a mesh file");
  if (size > kMostBytes)
    base::refuseFile(file,
                     "has " + std::to_string(size) + " bytes; allowed: up to " + std::to_string(kMostBytes));
  std::string bytes(size, '\0');
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), std::streamsize(size));
  if (!stream)
    base::refuseFile(file,
                     "cannot be read" + (errno == 0 ? "" : ": " + std::generic_category().message(errno)));
  return bytes;
}

void checkLooks(const PolygonSoup& soup) {
  for (std::size_t f = 0; f < soup.looks.size(); ++f)
    for (const CornerLook& look : soup.looks[f]) {
      const bool isUvThere = look.uv == kNoLook || look.uv < soup.uvs.size();
      const bool isNormalThere = look.normal == kNoLook || look.normal < soup.normals.size();
      if (!isUvThere || !isNormalThere)
        throw Error("face " + std::to_string(f) + " names a " +
                    (isUvThere ? "normal that is not there; allowed: those of the file, " +
                                     std::to_string(soup.normals.size())
                               : "texture coordinate that is not there; allowed: those of the file, " +
                                     std::to_string(soup.uvs.size())));
    }
}

void check(const PolygonSoup& soup, const char* format) {
  if (soup.points.empty() || soup.polygons.empty())
    throw Error(std::string("holds no faces that can be read as ") + format +
                "; allowed: vertices and faces of finite numbers");
  for (std::size_t p = 0; p < soup.points.size(); ++p)
    if (!soup.points[p].allFinite()) throw Error("vertex " + std::to_string(p) + " is not finite");
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto& polygon = soup.polygons[f];
    const std::string face = "face " + std::to_string(f);
    if (polygon.size() < 3 || polygon.size() > kMostCorners)
      throw Error(face + " has " + std::to_string(polygon.size()) + " corners; allowed: 3 to " +
                  std::to_string(kMostCorners));
    for (const std::uint32_t corner : polygon)
      if (corner >= soup.points.size())
        throw Error(face + " names a vertex that is not there; allowed: those of the file, " +
                    std::to_string(soup.points.size()));
  }
}

bool hasOpenEdges(const PolygonSoup& soup) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& polygon : soup.polygons)
    for (std::size_t k = 0; k < polygon.size(); ++k)
      edges.push_back(std::minmax({polygon[k], polygon[(k + 1) % polygon.size()]}));
  std::sort(edges.begin(), edges.end());
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::upper_bound(at, edges.end(), *at);
    if (end - at == 1) return true;
    at = end;
  }
  return false;
}

// Names the first of the points at each place.
void weld(PolygonSoup& soup) {
  std::vector<std::uint32_t> order(soup.points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const Eigen::Vector3d& p = soup.points[i];
    return std::tuple(p.x(), p.y(), p.z(), i);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(soup.points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool isSame = k > 0 && soup.points[order[k]] == soup.points[order[k - 1]];
    first[order[k]] = isSame ? first[order[k - 1]] : order[k];
  }
  for (auto& polygon : soup.polygons)
    for (std::uint32_t& corner : polygon) corner = first[corner];
}

// A corner that follows itself goes, and with it a polygon without area: its edges meet each other.
void dropRepeatedCorners(PolygonSoup& soup) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    std::vector<std::uint32_t>& polygon = soup.polygons[p];
    std::vector<CornerLook> none;
    std::vector<CornerLook>& looks = soup.looks.empty() ? none : soup.looks[p];
    std::size_t corners = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      if (corners > 0 && polygon[k] == polygon[corners - 1]) continue;
      polygon[corners] = polygon[k];
      if (!looks.empty()) looks[corners] = looks[k];
      ++corners;
    }
    while (corners > 1 && polygon[0] == polygon[corners - 1]) --corners;
    if (corners < 3) continue;
    polygon.resize(corners);
    if (!looks.empty()) looks.resize(corners);
    if (kept != p) {
      soup.polygons[kept] = std::move(polygon);
      if (!soup.looks.empty()) soup.looks[kept] = std::move(looks);
      if (!soup.materials.empty()) soup.materials[kept] = soup.materials[p];
    }
    ++kept;
  }
  soup.polygons.resize(kept);
  if (!soup.looks.empty()) soup.looks.resize(kept);
  if (!soup.materials.empty()) soup.materials.resize(kept);
}

// Newell's: the sum of the corners' cross products, twice the area long whatever the shape.
Eigen::Vector3d areaVector(const std::vector<std::uint32_t>& polygon,
                           const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = points[polygon[0]];
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += (points[polygon[k - 1]] - origin).cross(points[polygon[k]] - origin);
  return sum;
}

// What the file says of the polygon's corners, for the triangles from `first` on, into which it was cut.
void takeOverLooks(const PolygonSoup& soup, std::size_t p, std::size_t first, SurfaceMesh& mesh) {
  const std::vector<std::uint32_t>& polygon = soup.polygons[p];
  mesh.normals.resize(mesh.triangles.size(),
                      {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()});
  mesh.uvs.resize(mesh.triangles.size(),
                  {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()});
  if (soup.looks[p].empty()) return;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = std::find(polygon.begin(), polygon.end(), mesh.triangles[t][k]) - polygon.begin();
      const CornerLook& look = soup.looks[p][std::size_t(corner)];
      if (look.normal != kNoLook) mesh.normals[t][k] = soup.normals[look.normal];
      if (look.uv != kNoLook) mesh.uvs[t][k] = soup.uvs[look.uv];
    }
}

SurfaceMesh cutIntoTriangles(PolygonSoup soup) {
  SurfaceMesh mesh;
  mesh.vertices = std::move(soup.points);
  mesh.materialNames = std::move(soup.materialNames);
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const std::vector<std::uint32_t>& polygon = soup.polygons[p];
    const std::size_t first = mesh.triangles.size();
    const Eigen::Vector3d area = areaVector(polygon, mesh.vertices);
    const double length = area.norm();
    if (polygon.size() > 3 && length > 0 && std::isfinite(length)) {
      triangulate({&polygon, 1}, mesh.vertices, area / length, mesh.triangles);
    } else {
      triangulateFan(polygon, mesh.triangles);
    }
    if (!soup.looks.empty()) takeOverLooks(soup, p, first, mesh);
    if (!soup.materials.empty()) mesh.materials.resize(mesh.triangles.size(), soup.materials[p]);
  }
  if (soup.normals.empty()) mesh.normals.clear();
  if (soup.uvs.empty()) mesh.uvs.clear();
  return mesh;
}

}  // namespace

SurfaceMesh readMesh(const std::filesystem::path& file, double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw Error("scale is " + base::numberText(scale) + "; allowed: metres a unit, above 0 and finite");
  std::string bytes = bytesOf(file);
  const Ending& ending = endingOf(file);
  try {
    PolygonSoup soup = ending.parse(std::move(bytes));
    check(soup, ending.name);
    checkLooks(soup);
    for (Eigen::Vector3d& point : soup.points) point *= scale;
    if (hasOpenEdges(soup)) weld(soup);
    dropRepeatedCorners(soup);
    return cutIntoTriangles(std::move(soup));
  } catch (const Error& error) {
    base::refuseFile(file, error.what());
  }
}

}  // namespace rubble
