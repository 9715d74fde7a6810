#include "cook/triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <utility>

#include "cook/ear_clipping.h"

namespace rubble::cooking {
namespace {

double signedArea(const FlatLoop& loop) {
  double sum = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) sum += turn(loop[0], loop[k - 1], loop[k]);
  return sum / 2;
}

bool contains(const FlatLoop& loop, const Eigen::Vector2d& place) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2d& a = loop[k].place;
    const Eigen::Vector2d& b = loop[(k + 1) % loop.size()].place;
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    if (place.x() < a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

std::vector<FlatLoop> flatten(std::span<const Loop> loops, const std::vector<Eigen::Vector3d>& positions,
                              const Eigen::Vector3d& normal) {
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const Eigen::Vector3d& origin = positions[loops[0][0]];
  std::vector<FlatLoop> flat;
  for (const Loop& loop : loops) {
    FlatLoop& points = flat.emplace_back();
    for (const std::uint32_t id : loop) {
      const Eigen::Vector3d p = positions[id] - origin;
      points.push_back({{u.dot(p), v.dot(p)}, id});
    }
  }
  return flat;
}

// Whether the open segments cross; segments that share an end do not count.
bool cross(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, const FlatPoint& d) {
  if (a.id == c.id || a.id == d.id || b.id == c.id || b.id == d.id) return false;
  return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0);
}

bool isBlocked(const FlatPoint& a, const FlatPoint& b, const FlatLoop& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (cross(a, b, loop[k], loop[(k + 1) % loop.size()])) return true;
  return false;
}

struct Bridge {
  double length;
  std::size_t rim, hole;
};

// The shortest bridge between rim and hole that crosses neither them nor another hole. Any will do where
// rounding leaves none: the triangles are then crooked and still closed.
Bridge findBridge(const FlatLoop& rim, const std::vector<FlatLoop>& holes, std::size_t which) {
  std::vector<Bridge> bridges;
  for (std::size_t r = 0; r < rim.size(); ++r)
    for (std::size_t h = 0; h < holes[which].size(); ++h)
      bridges.push_back({(rim[r].place - holes[which][h].place).squaredNorm(), r, h});
  std::sort(bridges.begin(), bridges.end(), [](const Bridge& a, const Bridge& b) {
    return std::tie(a.length, a.rim, a.hole) < std::tie(b.length, b.rim, b.hole);
  });
  for (const Bridge& bridge : bridges) {
    const FlatPoint& a = rim[bridge.rim];
    const FlatPoint& b = holes[which][bridge.hole];
    const auto blocks = [&](const FlatLoop& loop) { return isBlocked(a, b, loop); };
    if (!blocks(rim) && std::none_of(holes.begin(), holes.end(), blocks)) return bridge;
  }
  return {0, 0, 0};
}

// rim up to the bridge, over it, round the hole, back over it, rest of the rim.
void joinHoles(FlatLoop& rim, std::vector<FlatLoop> holes) {
  while (!holes.empty()) {
    const Bridge bridge = findBridge(rim, holes, holes.size() - 1);
    FlatLoop& hole = holes.back();
    std::rotate(hole.begin(), hole.begin() + std::ptrdiff_t(bridge.hole), hole.end());
    FlatLoop inserted = hole;
    inserted.push_back(hole.front());
    inserted.push_back(rim[bridge.rim]);
    rim.insert(rim.begin() + std::ptrdiff_t(bridge.rim) + 1, inserted.begin(), inserted.end());
    holes.pop_back();
  }
}

// The smallest rim around the hole, or the count of rims.
std::size_t rimOf(const FlatLoop& hole, const std::vector<FlatLoop>& rims) {
  std::size_t best = rims.size();
  for (std::size_t r = 0; r < rims.size(); ++r) {
    if (!contains(rims[r], hole[0].place)) continue;
    if (best == rims.size() || signedArea(rims[r]) < signedArea(rims[best])) best = r;
  }
  return best;
}

}  // namespace

void triangulate(std::span<const Loop> loops, const std::vector<Eigen::Vector3d>& positions,
                 const Eigen::Vector3d& normal, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (loops.empty()) return;
  std::vector<FlatLoop> rims;
  std::vector<FlatLoop> holes;
  std::vector<FlatLoop> flat = flatten(loops, positions, normal);
  for (FlatLoop& loop : flat) {
    const bool isRim = flat.size() == 1 || signedArea(loop) >= 0;
    (isRim ? rims : holes).push_back(std::move(loop));
  }
  std::vector<std::vector<FlatLoop>> holesOf(rims.size());
  for (FlatLoop& hole : holes) {
    const std::size_t rim = rimOf(hole, rims);
    if (rim < holesOf.size()) {
      holesOf[rim].push_back(std::move(hole));
    } else {
      clipEars(hole, triangles);  // a sliver whose area rounding turned negative
    }
  }
  for (std::size_t r = 0; r < rims.size(); ++r) {
    joinHoles(rims[r], std::move(holesOf[r]));
    clipEars(rims[r], triangles);
  }
}

void triangulateFan(const Loop& loop, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (std::size_t k = 2; k < loop.size(); ++k) triangles.push_back({loop[0], loop[k - 1], loop[k]});
}

}  // namespace rubble::cooking
