#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/asset_check.h"

namespace rubble::base {
namespace {

constexpr std::size_t kMostElements = 10'000'000;  // the most that the cook makes
constexpr std::uint32_t kFewestTriangles = 4;      // of a closed surface
// A face's area is a float and may lack triangles that look the other way by rounding; a spring's is a
// double.
constexpr double kAreaTolerance = 1e-5;

void checkLength(std::size_t length, std::size_t elements, const char* array) {
  if (length != elements)
    refuseAsset(array, " has ", length, " entries for ", elements, " elements; allowed: one an element");
}

void checkNameable(std::size_t length, const char* array) {
  if (length == 0 || length >= kNoElement)
    refuseAsset(array, " has ", length, " entries; allowed: 1 to ", kNoElement - 1);
}

void checkIndex(std::uint32_t index, std::size_t end, const char* array, std::size_t at, const char* field) {
  if (index >= end) refuseAsset(array, '[', at, "].", field, " is ", index, "; allowed: 0 to ", end - 1);
}

void checkVertexElements(const Asset& asset) {
  const std::size_t n = asset.elementCount();
  for (std::size_t v = 0; v < asset.vertices.size(); ++v) {
    const auto& elements = asset.vertices[v].elements;
    std::size_t used = 0;
    while (used < elements.size() && elements[used] != kNoElement) ++used;
    if (used == 0) refuseAsset("vertices[", v, "].elements names none; allowed: 1 to 4 different ones");
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (e >= used && elements[e] != kNoElement)
        refuseAsset("vertices[", v, "].elements names ", elements[e],
                    " behind an unused place; allowed: unused "
                    "places last");
      if (e < used) checkIndex(elements[e], n, "vertices", v, "elements");
      if (e < used && std::count(elements.begin(), elements.begin() + std::ptrdiff_t(e), elements[e]) > 0)
        refuseAsset("vertices[", v, "].elements names ", elements[e], " twice; allowed: different ones");
    }
  }
}

// The cells follow one another and use every triangle and every face.
void checkRanges(const Asset& asset) {
  std::uint64_t triangle = 0;
  std::uint64_t face = 0;
  for (std::size_t i = 0; i < asset.cells.size(); ++i) {
    const Cell& cell = asset.cells[i];
    const auto checkRange = [i](std::uint64_t first, std::uint64_t due, std::uint64_t count,
                                std::uint64_t fewest, std::size_t length, const char* what) {
      if (first != due)
        refuseAsset("cells[", i, "] starts at ", what, ' ', first, "; allowed: ", due,
                    ", behind the cell before");
      if (count < fewest || count > length - due)
        refuseAsset("cells[", i, "] has ", count, ' ', what, "s; allowed: ", fewest, " to the ", length - due,
                    " that are left");
    };
    const std::uint64_t triangles = std::uint64_t{cell.outerTriangles} + cell.innerTriangles;
    checkRange(cell.firstTriangle, triangle, triangles, kFewestTriangles, asset.triangles.size(), "triangle");
    checkRange(cell.firstFace, face, cell.faceCount, 1, asset.faces.size(), "face");
    triangle += triangles;
    face += cell.faceCount;
  }
  if (triangle != asset.triangles.size() || face != asset.faces.size())
    refuseAsset("the last cell ends at triangle ", triangle, " and face ", face,
                "; allowed: ", asset.triangles.size(), " and ", asset.faces.size(),
                ", with which the arrays end");
}

void checkSprings(const Asset& asset) {
  const auto key = [](const AssetSpring& s) { return std::pair(s.first, s.second); };
  for (std::size_t s = 0; s < asset.springs.size(); ++s) {
    const AssetSpring& spring = asset.springs[s];
    checkIndex(spring.second, asset.elementCount(), "springs", s, "second");
    if (spring.first >= spring.second)
      refuseAsset("springs[", s, "].first is ", spring.first, "; allowed: less than its second, ",
                  spring.second);
    if (s > 0 && key(asset.springs[s - 1]) >= key(spring))
      refuseAsset("springs[", s, "] joins ", spring.first, " and ", spring.second,
                  ", out of order or for the second time; allowed: rising pairs");
  }
}

void checkAnchors(const Asset& asset) {
  for (std::size_t a = 0; a < asset.anchors.size(); ++a) {
    const std::uint32_t element = asset.anchors[a].element;
    checkIndex(element, asset.elementCount(), "anchors", a, "element");
    if (a > 0 && asset.anchors[a - 1].element > element)
      refuseAsset("anchors[", a, "].element is ", element, "; allowed: not less than the one before, ",
                  asset.anchors[a - 1].element);
  }
}

// The faces of one cell by their neighbour. The table is by element and never cleared: an entry counts only
// while it names a face of the present cell.
class FacesOfCell {
 public:
  explicit FacesOfCell(const Asset& asset) : m_asset(asset), m_faceTo(asset.cells.size(), kNoElement) {}

  void enter(std::uint32_t cell) {
    m_first = m_asset.cells[cell].firstFace;
    m_end = m_first + m_asset.cells[cell].faceCount;
    for (std::uint32_t f = m_first; f < m_end; ++f) {
      const std::uint32_t neighbour = m_asset.faces[f].neighbour;
      if (neighbour == kNoElement) continue;
      if (const CellFace* other = find(neighbour))
        refuseAsset("faces[", f, "].neighbour is ", neighbour, ", that of faces[",
                    other - m_asset.faces.data(), "] of cell ", cell, " too; allowed: once a cell");
      m_faceTo[neighbour] = f;
    }
  }
  const CellFace* find(std::uint32_t neighbour) const {
    const std::uint32_t f = m_faceTo[neighbour];
    return f >= m_first && f < m_end ? &m_asset.faces[f] : nullptr;
  }

 private:
  const Asset& m_asset;
  std::vector<std::uint32_t> m_faceTo;
  std::uint32_t m_first = 0, m_end = 0;
};

// For each cell those of smaller index that have a face towards it.
struct SmallerNeighbours {
  std::vector<std::uint32_t> start, cells;

  explicit SmallerNeighbours(const Asset& asset) : start(asset.cells.size() + 1, 0) {
    const auto visit = [&asset](auto&& towards) {
      for (std::uint32_t i = 0; i < asset.cells.size(); ++i) {
        for (const CellFace& face : asset.cellFaces(i))
          if (face.neighbour != kNoElement && face.neighbour > i) towards(face.neighbour, i);
      }
    };
    visit([this](std::uint32_t to, std::uint32_t) { ++start[to + 1]; });
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    cells.resize(start.back());
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    visit([this, &at](std::uint32_t to, std::uint32_t from) { cells[at[to]++] = from; });
  }
};

}  // namespace

void checkCounts(const Asset& asset) {
  const std::size_t n = asset.elementCount();
  if (n == 0) refuseAsset("no elements; allowed: 1 to ", kMostElements);
  if (n > kMostElements) refuseAsset(n, " elements; allowed: 1 to ", kMostElements);
  checkLength(asset.volumes.size(), n, "volumes");
  checkLength(asset.gyrations.size(), n, "gyrations");
  checkLength(asset.cells.size(), n, "cells");
  checkNameable(asset.vertices.size(), "vertices");
  checkNameable(asset.corners.size(), "corners");
  checkNameable(asset.triangles.size(), "triangles");
  checkNameable(asset.faces.size(), "faces");
  if (!asset.rest) return;
  checkLength(asset.rest->displacements.size(), n, "rest.displacements");
  checkLength(asset.rest->rotations.size(), n, "rest.rotations");
}

void checkIndices(const Asset& asset) {
  checkVertexElements(asset);
  checkRanges(asset);
  checkSprings(asset);
  checkAnchors(asset);
}

void checkNeighbours(const Asset& asset) {
  const SmallerNeighbours smaller(asset);
  FacesOfCell faces(asset);
  auto spring = asset.springs.begin();
  for (std::uint32_t i = 0; i < asset.cells.size(); ++i) {
    faces.enter(i);
    const auto isSmaller = [i](const CellFace& face) { return face.neighbour < i; };
    const auto cellFaces = asset.cellFaces(i);
    std::size_t back = std::size_t(std::count_if(cellFaces.begin(), cellFaces.end(), isSmaller));
    for (std::uint32_t k = smaller.start[i]; k < smaller.start[i + 1]; ++k, --back)
      if (!faces.find(smaller.cells[k]))
        refuseAsset("cell ", smaller.cells[k], " has a face towards cell ", i,
                    ", which has none back; allowed: faces "
                    "on both sides");
    if (back != 0)
      refuseAsset("cell ", i, " has ", back,
                  " faces towards cells that have none back; allowed: faces on both sides");
    for (; spring != asset.springs.end() && spring->first == i; ++spring) {
      const auto s = spring - asset.springs.begin();
      const CellFace* face = faces.find(spring->second);
      if (!face)
        refuseAsset("springs[", s, "] joins ", i, " and ", spring->second,
                    ", whose cells share no face; allowed: cells that do");
      if (!(spring->area <= (1 + kAreaTolerance) * double(face->area)))
        refuseAsset("springs[", s, "].area is ", spring->area,
                    " m^2; allowed: up to that of the cells' shared face, ", face->area);
    }
  }
}

}  // namespace rubble::base
