#include "bullet/convex_cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffu;
// Triangles whose normals differ by less are of one flat face: cell vertices are floats.
constexpr double kFlat = 1e-4;

// Normals that differ by more meet in an edge and not in a smooth face.
constexpr double kSharp = 0.5;
// What is kept of smooth faces: points in cubes of this share of the elements' spacing, crossings one in so
// many.
constexpr double kThinning = 1;
constexpr std::size_t kKeptOfSmooth = 6;

using Corners = std::array<std::uint32_t, 3>;

// Twice the area along the normal.
Eigen::Vector3d areaOf(const CutSurface& surface, const Corners& t) {
  return (surface.points[t[1]] - surface.points[t[0]]).cross(surface.points[t[2]] - surface.points[t[0]]);
}

// Of each point what is below and above it; neither of what is on it.
void findSides(const std::vector<double>& over, double nearness, std::vector<std::uint8_t>& sides) {
  sides.resize(over.size());
  for (std::size_t i = 0; i < over.size(); ++i)
    sides[i] = std::uint8_t((over[i] <= -nearness ? Crossings::kBelow : 0) |
                            (over[i] >= nearness ? Crossings::kAbove : 0));
}

// Sides that a triangle is on, by those of its corners.
std::uint8_t sidesOf(const CutSurface& surface, const Corners& t, const std::vector<std::uint8_t>& sides,
                     const CutPlane& plane) {
  const auto all = std::uint8_t(sides[t[0]] | sides[t[1]] | sides[t[2]]);
  if (all != 0) return all;
  return areaOf(surface, t).dot(plane.normal) > 0 ? Crossings::kBelow : Crossings::kAbove;
}

void findDistances(const CutSurface& surface, const CutPlane& plane, std::vector<double>& over) {
  over.resize(surface.points.size());
  for (std::size_t i = 0; i < over.size(); ++i) over[i] = plane.over(surface.points[i]);
}

Eigen::Vector3d crossing(const CutSurface& surface, std::uint32_t a, std::uint32_t b,
                         const std::vector<double>& over) {
  const double share = over[a] / (over[a] - over[b]);
  return surface.points[a] + share * (surface.points[b] - surface.points[a]);
}

// Of where edges cross a plane, one after the other.
struct CrossingUse {
  std::size_t smooth = 0;
  PointUse useOf(PointUse a, PointUse b) {
    if (a == PointUse::Flat || b == PointUse::Flat) return PointUse::Outline;
    if (a != PointUse::Smooth && b != PointUse::Smooth) return PointUse::Corner;
    return smooth++ % kKeptOfSmooth == 0 ? PointUse::Corner : PointUse::Outline;
  }
};

// Takes points of the surface that is cut over into a half, each once.
struct Half {
  CutSurface surface;
  std::vector<std::uint32_t> known;
  CrossingUse crossings;

  std::uint32_t take(const CutSurface& from, std::uint32_t point, bool isOn) {
    const PointUse use = from.uses[point];
    if (known[point] == kNoPoint)
      known[point] = add(from.points[point], isOn && use != PointUse::Corner ? PointUse::Outline : use);
    return known[point];
  }
  std::uint32_t add(const Eigen::Vector3d& point, PointUse use) {
    surface.points.push_back(point);
    surface.uses.push_back(use);
    return std::uint32_t(surface.points.size() - 1);
  }
};

// The part of a crossing triangle on one side: up to four corners.
void addClipped(const CutSurface& from, const Corners& t, const std::vector<double>& over, double sign,
                double nearness, Half& half) {
  std::array<std::uint32_t, 5> ring{};
  std::size_t count = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t a = t[c], b = t[(c + 1) % 3];
    const double da = sign * over[a], db = sign * over[b];
    if (da > -nearness) ring[count++] = half.take(from, a, std::abs(da) < nearness);
    if ((da >= nearness && db <= -nearness) || (da <= -nearness && db >= nearness))
      ring[count++] = half.add(crossing(from, a, b, over), half.crossings.useOf(from.uses[a], from.uses[b]));
  }
  for (std::size_t c = 2; c < count; ++c) half.surface.triangles.push_back({ring[0], ring[c - 1], ring[c]});
}

// Of smooth faces one point in a cube of the elements' spacing is a corner.
void findUses(double spacing, CutSurface& all) {
  all.uses.assign(all.points.size(), PointUse::Flat);
  std::vector<Eigen::Vector3d> normals(all.points.size(), Eigen::Vector3d::Zero());
  for (const Corners& t : all.triangles) {
    const Eigen::Vector3d area = areaOf(all, t);
    if (!(area.squaredNorm() > 0)) continue;
    const Eigen::Vector3d normal = area.normalized();
    for (const std::uint32_t p : t) {
      if (normals[p].isZero(0)) normals[p] = normal;
      const double change = (normals[p] - normal).norm();
      if (change > kSharp) all.uses[p] = PointUse::Corner;
      if (change > kFlat && all.uses[p] == PointUse::Flat) all.uses[p] = PointUse::Smooth;
    }
  }
  std::unordered_set<std::uint64_t> taken;
  for (std::size_t p = 0; p < all.points.size(); ++p) {
    if (all.uses[p] != PointUse::Smooth) continue;
    std::uint64_t cube = 0;
    for (const double x : all.points[p])
      cube = (cube << 21) ^ (std::uint64_t(std::llround(x / (kThinning * spacing))) & 0x1fffff);
    if (taken.insert(cube).second) all.uses[p] = PointUse::Corner;
  }
}

}  // namespace

CutSurface outerSurface(const Asset& asset) {
  CutSurface all;
  std::vector<std::uint32_t> known(asset.vertices.size(), kNoPoint);
  for (const Cell& cell : asset.cells) {
    for (std::uint32_t t = cell.firstTriangle; t < cell.firstTriangle + cell.outerTriangles; ++t) {
      Corners corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = asset.corners[asset.triangles[t][c]].vertex;
        if (known[vertex] == kNoPoint) {
          known[vertex] = std::uint32_t(all.points.size());
          all.points.push_back(asset.vertices[vertex].position.cast<double>());
        }
        corners[c] = known[vertex];
      }
      all.triangles.push_back(corners);
    }
  }
  findUses(asset.spacing(), all);
  return all;
}

void findCrossings(const CutSurface& surface, const CutPlane& plane, double nearness, Crossings& found) {
  findDistances(surface, plane, found.over);
  findSides(found.over, nearness, found.ofPoint);
  found.sides = found.ofPoint;
  found.between.clear();
  const std::vector<double>& over = found.over;
  for (const Corners& t : surface.triangles) {
    const std::uint8_t sides = sidesOf(surface, t, found.ofPoint, plane);
    for (const std::uint32_t p : t)
      if (found.ofPoint[p] == 0) found.sides[p] |= sides;
    if (sides != (Crossings::kBelow | Crossings::kAbove)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      // Both triangles of an edge find it; one is enough.
      if (over[a] <= -nearness && over[b] >= nearness) found.between.push_back(crossing(surface, a, b, over));
    }
  }
}

std::array<CutSurface, 2> cutSurface(const CutSurface& surface, const CutPlane& plane, double nearness) {
  std::vector<double> over;
  std::vector<std::uint8_t> ofPoint;
  findDistances(surface, plane, over);
  findSides(over, nearness, ofPoint);
  Half below{{}, std::vector<std::uint32_t>(surface.points.size(), kNoPoint), {}}, above = below;
  for (const Corners& t : surface.triangles) {
    const std::uint8_t sides = sidesOf(surface, t, ofPoint, plane);
    for (Half* half : {&below, &above}) {
      const bool isBelow = half == &below;
      if (!(sides & (isBelow ? Crossings::kBelow : Crossings::kAbove))) continue;
      if (sides == (Crossings::kBelow | Crossings::kAbove)) {
        addClipped(surface, t, over, isBelow ? -1 : 1, nearness, *half);
      } else {
        Corners& taken = half->surface.triangles.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
          taken[c] = half->take(surface, t[c], std::abs(over[t[c]]) < nearness);
      }
    }
  }
  return {std::move(below.surface), std::move(above.surface)};
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
