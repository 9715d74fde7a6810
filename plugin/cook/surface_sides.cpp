#include "cook/surface_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/groups.h"

namespace rubble::cooking {
namespace {

constexpr std::uint64_t kNoSide = ~std::uint64_t(0);

// Behind side s of triangle t, number 3 t + s, lies the side with the number sides[3 t + s], or none.
using Pairing = std::vector<std::uint64_t>;

std::uint64_t numberOf(const SoupEdge& side) {
  return 3 * std::uint64_t(side.triangle) + side.side;
}

void pair(Pairing& behind, const SoupEdge& a, const SoupEdge& b) {
  behind[numberOf(a)] = numberOf(b);
  behind[numberOf(b)] = numberOf(a);
}

struct Leaf {
  SoupEdge side;
  double angle;  // about the edge, counter-clockwise where its higher vertex points to who looks [rad]
};

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSameAngle = 1e-9;  // walls of parts that touch [rad]

double wedge(const Leaf& from, const Leaf& to) {
  const double angle = to.angle - from.angle;
  return angle < 0 ? angle + kTurn : angle;
}

std::vector<Leaf> leavesAround(const Soup& soup, std::span<const SoupEdge> sides) {
  const Eigen::Vector3d& low = soup.vertices[sides[0].low];
  const Eigen::Vector3d way = (soup.vertices[sides[0].high] - low).normalized();
  std::vector<Leaf> leaves;
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = first;
  for (const SoupEdge& side : sides) {
    const Eigen::Vector3d arm = soup.vertices[soup.triangles[side.triangle][(side.side + 2) % 3]] - low;
    const Eigen::Vector3d across = arm - way * way.dot(arm);
    if (leaves.empty()) {
      first = across;
      second = way.cross(across);
    }
    double angle = std::atan2(across.dot(second), across.dot(first));
    if (angle < 0) angle += kTurn;
    if (leaves.empty() || angle > kTurn - kSameAngle) angle = 0;
    leaves.push_back({side, angle});
  }
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
  // Of leaves that lie on each other that one first that turns unlike the one before.
  const auto lieTogether = [&leaves](std::size_t k) { return wedge(leaves[k], leaves[k + 1]) < kSameAngle; };
  if (lieTogether(0)) std::rotate(leaves.begin(), leaves.begin() + 2, leaves.end());
  for (std::size_t k = 1; k + 1 < leaves.size(); ++k)
    if (leaves[k].side.upward == leaves[k - 1].side.upward && lieTogether(k))
      std::swap(leaves[k], leaves[k + 1]);
  return leaves;
}

// Pairs the leaves of an edge such that each two have solid between them. A triangle that runs up the edge
// has its outer side where the angle grows, and so the solid where it is smaller.
void pairLeaves(const Soup& soup, std::span<const SoupEdge> sides, Pairing& behind) {
  const std::vector<Leaf> leaves = leavesAround(soup, sides);
  bool alternate = true;
  double evenWedges = 0;  // from the first to the second, the third to the fourth, ...
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const Leaf& next = leaves[(k + 1) % leaves.size()];
    alternate = alternate && leaves[k].side.upward != next.side.upward;
    if (k % 2 == 0) evenWedges += wedge(leaves[k], next);
  }
  // Where they do not turn alternately it is not known where the solid is: the sharper wedges.
  const bool startsEven = alternate ? !leaves[0].side.upward : evenWedges <= kTurn / 2;
  for (std::size_t k = startsEven ? 0 : 1; k < leaves.size(); k += 2)
    pair(behind, leaves[k].side, leaves[(k + 1) % leaves.size()].side);
}

struct Pairs {
  Pairing behind;
  std::size_t parted = 0;
};

std::optional<Pairs> pairSides(const Soup& soup) {
  Pairs pairs;
  pairs.behind.assign(3 * soup.triangles.size(), kNoSide);
  bool isSurface = true;
  forEachEdge(sortedEdges(soup), [&](std::span<const SoupEdge> sides) {
    if (sides.size() == 2) pair(pairs.behind, sides[0], sides[1]);
    if (sides.size() <= 2) return;
    isSurface = isSurface && sides.size() % 2 == 0;
    if (!isSurface) return;
    pairLeaves(soup, sides, pairs.behind);
    ++pairs.parted;
  });
  if (!isSurface) return std::nullopt;
  return pairs;
}

std::uint32_t startOf(const Soup& soup, std::uint64_t side) {
  return soup.triangles[side / 3][side % 3];
}

// Which triangles to turn, so that all of a surface turn alike and as few as possible are turned; none where
// it has one side.
std::optional<std::vector<bool>> findTurns(const Soup& soup, const Pairing& behind) {
  enum class Turn : std::uint8_t { Unknown, Keep, Change };
  std::vector<Turn> turns(soup.triangles.size(), Turn::Unknown);
  for (std::uint32_t seed = 0; seed < soup.triangles.size(); ++seed) {
    if (turns[seed] != Turn::Unknown) continue;
    std::vector<std::uint32_t> surface = {seed};
    turns[seed] = Turn::Keep;
    std::size_t changes = 0;
    for (std::size_t at = 0; at < surface.size(); ++at)
      for (std::uint64_t side = 3 * std::uint64_t(surface[at]); side < 3 * std::uint64_t(surface[at]) + 3;
           ++side) {
        if (behind[side] == kNoSide) continue;
        const auto other = std::uint32_t(behind[side] / 3);
        const bool turnAlike = startOf(soup, side) != startOf(soup, behind[side]);
        const Turn turn = (turns[surface[at]] == Turn::Keep) == turnAlike ? Turn::Keep : Turn::Change;
        if (turns[other] == Turn::Unknown) {
          turns[other] = turn;
          changes += turn == Turn::Change ? 1 : 0;
          surface.push_back(other);
        } else if (turns[other] != turn) {
          return std::nullopt;
        }
      }
    if (2 * changes > surface.size())
      for (const std::uint32_t t : surface) turns[t] = turns[t] == Turn::Keep ? Turn::Change : Turn::Keep;
  }
  std::vector<bool> isTurned(turns.size());
  for (std::size_t t = 0; t < turns.size(); ++t) isTurned[t] = turns[t] == Turn::Change;
  return isTurned;
}

// A vertex for each fan of triangles that go on across sides.
void partVertices(Soup& soup, const Pairing& behind) {
  base::Groups corners(3 * soup.triangles.size());  // by 3 t + corner
  const auto cornerAt = [&soup](std::uint64_t triangle, std::uint32_t vertex) {
    const std::array<std::uint32_t, 3>& at = soup.triangles[triangle];
    return std::uint32_t(3 * triangle + (at[0] == vertex ? 0u : at[1] == vertex ? 1u : 2u));
  };
  for (std::uint64_t side = 0; side < behind.size(); ++side) {
    if (behind[side] == kNoSide) continue;
    for (const std::uint64_t corner : {side % 3, (side + 1) % 3}) {
      const std::uint32_t vertex = soup.triangles[side / 3][corner];
      corners.join(std::uint32_t(side - side % 3 + corner), cornerAt(behind[side] / 3, vertex));
    }
  }
  std::vector<bool> isTaken(soup.vertices.size(), false);
  std::vector<std::uint32_t> vertexOf(3 * soup.triangles.size(), kNoElement);  // by group
  for (std::uint32_t corner = 0; corner < vertexOf.size(); ++corner) {
    std::uint32_t& vertex = soup.triangles[corner / 3][corner % 3];
    std::uint32_t& own = vertexOf[corners.of(corner)];
    if (own == kNoElement) {
      own = vertex;
      if (isTaken[vertex]) {
        own = std::uint32_t(soup.vertices.size());
        soup.vertices.push_back(Eigen::Vector3d(soup.vertices[vertex]));
      } else {
        isTaken[vertex] = true;
      }
    }
    vertex = own;
  }
}

// Two triangles that go together at an edge from a to b.
struct Joint {
  std::array<std::uint32_t, 2> triangles;
  std::uint32_t a, b;
};

// Those at edges that have four triangles although vertices were parted: where surfaces touch along a single
// edge, its ends are still one fan each.
std::vector<Joint> findCrowded(const Soup& soup, const Pairing& behind) {
  std::vector<Joint> joints;
  forEachEdge(sortedEdges(soup), [&](std::span<const SoupEdge> sides) {
    if (sides.size() <= 2) return;
    for (const SoupEdge& side : sides) {
      const auto other = std::uint32_t(behind[numberOf(side)] / 3);
      if (side.triangle < other) joints.push_back({{side.triangle, other}, side.low, side.high});
    }
  });
  return joints;
}

// Cuts each two triangles in the middle of their edge, which so becomes one of their own; those that share a
// triangle with another wait for their turn.
void cutCrowded(Soup& soup, const std::vector<Joint>& joints) {
  std::vector<bool> isCut(soup.triangles.size(), false);
  for (const auto& [triangles, a, b] : joints) {
    if (isCut[triangles[0]] || isCut[triangles[1]]) continue;
    const auto middle = std::uint32_t(soup.vertices.size());
    soup.vertices.push_back((soup.vertices[a] + soup.vertices[b]) / 2);
    for (const std::uint32_t t : triangles) {
      isCut[t] = true;
      auto half = soup.triangles[t];
      std::replace(half.begin(), half.end(), a, middle);
      std::replace(soup.triangles[t].begin(), soup.triangles[t].end(), b, middle);
      soup.triangles.push_back(half);
      soup.sources.push_back(Source(soup.sources[t]));
    }
  }
}

}  // namespace

std::optional<Sided> makeSided(Soup& soup) {
  std::optional<Sided> sided;
  for (;;) {
    const std::optional<Pairs> pairs = pairSides(soup);
    if (!pairs) return std::nullopt;
    const auto turns = findTurns(soup, pairs->behind);
    if (!turns) return std::nullopt;
    if (!sided) sided = Sided{pairs->parted};
    partVertices(soup, pairs->behind);
    const std::vector<Joint> crowded = findCrowded(soup, pairs->behind);
    for (std::size_t t = 0; t < turns->size(); ++t)  // sides change their numbers
      if ((*turns)[t]) std::swap(soup.triangles[t][1], soup.triangles[t][2]);
    if (crowded.empty()) return sided;
    cutCrowded(soup, crowded);
  }
}

}  // namespace rubble::cooking
