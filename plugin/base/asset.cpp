#include "rubble/asset.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "rubble/error.h"

namespace rubble {
namespace {

// A normal is stored in floats; this is a few hundred times their rounding, and far from any wrong normal.
constexpr float kUnitTolerance = 1e-4f;

template <class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  std::ostringstream text;
  text << "asset: ";
  (text << ... << parts);
  throw Error(text.str());
}

bool isUnit(const Eigen::Vector3f& v) {
  return std::abs(v.norm() - 1.0f) <= kUnitTolerance;
}

bool isPositive(double value) {
  return std::isfinite(value) && value > 0;
}

void checkElements(const Asset& asset) {
  const std::size_t n = asset.elementCount();
  if (n == 0) fail("no elements");
  if (n >= kNoElement) fail(n, " elements: more than an index can name");
  if (asset.volumes.size() != n) fail(asset.volumes.size(), " volumes for ", n, " elements");
  if (asset.gyrations.size() != n) fail(asset.gyrations.size(), " gyrations for ", n, " elements");
  if (asset.cells.size() != n) fail(asset.cells.size(), " cells for ", n, " elements");
  if (!isPositive(asset.radius)) fail("radius ", asset.radius, " m is not positive");
  for (std::size_t i = 0; i < n; ++i) {
    if (!asset.positions[i].allFinite()) fail("position of element ", i, " is not finite");
    if (!isPositive(asset.volumes[i])) fail("volume of element ", i, " is not positive");
    if (!isPositive(asset.gyrations[i])) fail("gyration of element ", i, " is not positive");
  }
}

void checkSprings(const Asset& asset) {
  const std::size_t n = asset.elementCount();
  const auto key = [](const AssetSpring& s) { return std::pair(s.first, s.second); };
  for (std::size_t s = 0; s < asset.springs.size(); ++s) {
    const AssetSpring& spring = asset.springs[s];
    if (spring.second >= n || spring.first >= spring.second)
      fail("spring ", s, " names a wrong pair of elements");
    if (!isPositive(spring.area)) fail("area of spring ", s, " is not positive");
    if (s > 0 && key(asset.springs[s - 1]) >= key(spring))
      fail("spring ", s, " is out of order or there twice");
  }
  for (std::size_t a = 0; a < asset.anchors.size(); ++a) {
    const AssetAnchor& anchor = asset.anchors[a];
    if (anchor.element >= n) fail("anchor ", a, " names a wrong element");
    if (!isPositive(anchor.area)) fail("area of anchor ", a, " is not positive");
    if (!anchor.point.allFinite()) fail("point of anchor ", a, " is not finite");
    if (a > 0 && asset.anchors[a - 1].element > anchor.element) fail("anchor ", a, " is out of order");
  }
}

void checkVertices(const Asset& asset) {
  const std::size_t n = asset.elementCount();
  for (std::size_t v = 0; v < asset.vertices.size(); ++v) {
    const CellVertex& vertex = asset.vertices[v];
    if (!vertex.position.allFinite()) fail("cell vertex ", v, " is not finite");
    bool ended = false;
    for (const std::uint32_t element : vertex.elements) {
      if (element != kNoElement && (ended || element >= n)) fail("cell vertex ", v, " names a wrong element");
      ended = element == kNoElement;
    }
    if (vertex.elements[0] == kNoElement) fail("cell vertex ", v, " touches no element");
  }
  for (std::size_t c = 0; c < asset.corners.size(); ++c) {
    const CellCorner& corner = asset.corners[c];
    if (corner.vertex >= asset.vertices.size()) fail("corner ", c, " names a wrong vertex");
    const auto& elements = asset.vertices[corner.vertex].elements;
    if (corner.element >= n || std::find(elements.begin(), elements.end(), corner.element) == elements.end())
      fail("corner ", c, " belongs to an element that its vertex does not touch");
    if (!isUnit(corner.normal)) fail("normal of corner ", c, " is not a unit vector");
  }
}

void checkFaces(const Asset& asset) {
  for (std::size_t f = 0; f < asset.faces.size(); ++f) {
    const CellFace& face = asset.faces[f];
    if (face.neighbour != kNoElement && face.neighbour >= asset.elementCount())
      fail("face ", f, " names a wrong neighbour");
    if (!std::isfinite(face.area) || face.area < 0) fail("area of face ", f, " is negative or not finite");
    if (!isUnit(face.normal)) fail("normal of face ", f, " is not a unit vector");
    if (!face.centroid.allFinite()) fail("centroid of face ", f, " is not finite");
  }
}

// The cells follow one another and use every triangle and every face.
void checkCells(const Asset& asset) {
  std::uint64_t triangle = 0;
  std::uint64_t face = 0;
  for (std::size_t i = 0; i < asset.cells.size(); ++i) {
    const Cell& cell = asset.cells[i];
    if (cell.firstTriangle != triangle || cell.firstFace != face)
      fail("cell ", i, " does not follow the one before");
    const std::uint64_t end = triangle + cell.outerTriangles + cell.innerTriangles;
    if (end > asset.triangles.size()) fail("cell ", i, " has more triangles than there are");
    for (; triangle < end; ++triangle) {
      for (const std::uint32_t corner : asset.triangles[triangle])
        if (corner >= asset.corners.size() || asset.corners[corner].element != i)
          fail("triangle ", triangle, " of cell ", i, " names a wrong corner");
    }
    face += cell.faceCount;
    if (face > asset.faces.size()) fail("cell ", i, " has more faces than there are");
  }
  if (triangle != asset.triangles.size()) fail("triangles that belong to no cell");
  if (face != asset.faces.size()) fail("faces that belong to no cell");
}

}  // namespace

double Asset::volume() const {
  double sum = 0;
  for (const double volume : volumes) sum += volume;
  return sum;
}

double Asset::spacing() const {
  return volumes.empty() ? 0.0 : std::cbrt(volume() / double(volumes.size()));
}

Eigen::AlignedBox3d Asset::bounds() const {
  Eigen::AlignedBox3d box;
  for (const CellVertex& vertex : vertices) box.extend(vertex.position.cast<double>());
  return box;
}

double Asset::diagonal() const {
  const Eigen::AlignedBox3d box = bounds();
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::span<const CellFace> Asset::cellFaces(std::size_t element) const {
  const Cell& cell = cells[element];
  return std::span(faces).subspan(cell.firstFace, cell.faceCount);
}

void Asset::validate() const {
  checkElements(*this);
  checkSprings(*this);
  checkVertices(*this);
  checkFaces(*this);
  checkCells(*this);
}

}  // namespace rubble
