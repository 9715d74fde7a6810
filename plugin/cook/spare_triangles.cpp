#include "cook/spare_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/groups.h"

namespace rubble::cooking {
namespace {

// Twice the area of a triangle over its longest side squared, below which rounding made the rest of it.
constexpr double kFlat = 1e-12;

bool isFlat(const Soup& soup, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d& a = soup.vertices[triangle[0]];
  const Eigen::Vector3d& b = soup.vertices[triangle[1]];
  const Eigen::Vector3d& c = soup.vertices[triangle[2]];
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() <= kFlat * longest;
}

// For each triangle the number of its edge at each side, and how many triangles an edge has.
struct EdgeUse {
  std::vector<std::array<std::uint32_t, 3>> edges;
  std::vector<std::uint32_t> uses;
};

EdgeUse countUses(const Soup& soup) {
  EdgeUse use{std::vector<std::array<std::uint32_t, 3>>(soup.triangles.size()), {}};
  forEachEdge(sortedEdges(soup), [&use](std::span<const SoupEdge> sides) {
    for (const SoupEdge& side : sides) use.edges[side.triangle][side.side] = std::uint32_t(use.uses.size());
    use.uses.push_back(std::uint32_t(sides.size()));
  });
  return use;
}

bool isAmiss(std::uint32_t uses) {
  return uses != 0 && uses != 2;
}

// Triangles with the same corners.
struct Stack {
  std::vector<std::uint32_t> triangles;
  int turn = 0;  // those that turn one way less those that turn the other way
};

// Whether the corners must be swapped an even number of times to be in order.
bool isEven(const std::array<std::uint32_t, 3>& t) {
  return (int(t[0] > t[1]) + int(t[1] > t[2]) + int(t[0] > t[2])) % 2 == 0;
}

std::vector<Stack> findStacks(const Soup& soup) {
  std::vector<std::array<std::uint32_t, 4>> keys;
  keys.reserve(soup.triangles.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    auto corners = soup.triangles[t];
    std::sort(corners.begin(), corners.end());
    keys.push_back({corners[0], corners[1], corners[2], t});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Stack> stacks;
  for (std::size_t at = 0; at < keys.size();) {
    Stack stack;
    const std::size_t first = at;
    for (; at < keys.size() && std::equal(keys[at].begin(), keys[at].begin() + 3, keys[first].begin());
         ++at) {
      stack.triangles.push_back(keys[at][3]);
      stack.turn += isEven(soup.triangles[keys[at][3]]) ? 1 : -1;
    }
    if (stack.triangles.size() > 1) stacks.push_back(std::move(stack));
  }
  return stacks;
}

// Of those that turn as most do the first.
std::uint32_t keeper(const Soup& soup, const Stack& stack) {
  for (const std::uint32_t t : stack.triangles)
    if (stack.turn == 0 || isEven(soup.triangles[t]) == (stack.turn > 0)) return t;
  return stack.triangles.front();
}

// Whether each stack of as many triangles either way is a wall: regions of them end at edges that without
// them have two triangles, or four.
std::vector<bool> findWalls(const Soup& soup, const std::vector<Stack>& stacks,
                            const std::vector<bool>& isSpare) {
  std::vector<std::uint32_t> stackOf(soup.triangles.size(), kNoElement);
  for (std::uint32_t s = 0; s < stacks.size(); ++s)
    if (stacks[s].turn == 0)
      for (const std::uint32_t t : stacks[s].triangles) stackOf[t] = s;
  base::Groups regions(stacks.size());
  std::vector<std::array<std::uint32_t, 2>>
      borders;  // a stack, and the triangles there that are kept for sure
  forEachEdge(sortedEdges(soup), [&](std::span<const SoupEdge> sides) {
    std::uint32_t others = 0;
    std::uint32_t stack = kNoElement;
    std::size_t stacked = 0;
    for (const SoupEdge& side : sides) {
      const std::uint32_t s = stackOf[side.triangle];
      if (s == kNoElement) {
        others += isSpare[side.triangle] ? 0 : 1;
      } else {
        if (stack != kNoElement) regions.join(s, stack);
        stacked += s == stack ? 0 : 1;
        stack = s;
      }
    }
    if (stack != kNoElement && (others > 0 || stacked == 1)) borders.push_back({stack, others});
  });
  std::vector<bool> isOpen(stacks.size(), false), hasBorder(stacks.size(), false);
  for (const auto& [stack, others] : borders) {
    hasBorder[regions.of(stack)] = true;
    if (others == 0 || others % 2 != 0) isOpen[regions.of(stack)] = true;
  }
  std::vector<bool> isWall(stacks.size(), false);
  for (std::uint32_t s = 0; s < stacks.size(); ++s)
    isWall[s] = stacks[s].turn == 0 && hasBorder[regions.of(s)] && !isOpen[regions.of(s)];
  return isWall;
}

}  // namespace

std::size_t dropFlat(Soup& soup) {
  const std::size_t before = soup.triangles.size();
  std::vector<bool> isSpare(before, false);
  for (std::size_t t = 0; t < before; ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    isSpare[t] = a == b || b == c || c == a;
  }
  dropTriangles(soup, isSpare);
  EdgeUse use = countUses(soup);
  isSpare.assign(soup.triangles.size(), false);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (!isFlat(soup, soup.triangles[t])) continue;
    int gain = 0;
    for (const std::uint32_t edge : use.edges[t])
      gain += int(isAmiss(use.uses[edge])) - int(isAmiss(use.uses[edge] - 1));
    if (gain <= 0) continue;
    isSpare[t] = true;
    for (const std::uint32_t edge : use.edges[t]) --use.uses[edge];
  }
  dropTriangles(soup, isSpare);
  return before - soup.triangles.size();
}

std::size_t dropCopies(Soup& soup) {
  const std::size_t before = soup.triangles.size();
  std::vector<bool> isSpare(before, false);
  for (const Stack& stack : findStacks(soup)) {
    std::array<bool, 2> isKept = {false, false};
    for (const std::uint32_t t : stack.triangles) {
      bool& kept = isKept[isEven(soup.triangles[t]) ? 0 : 1];
      isSpare[t] = kept;
      kept = true;
    }
  }
  dropTriangles(soup, isSpare);
  return before - soup.triangles.size();
}

std::size_t dropDoubled(Soup& soup) {
  const std::size_t before = soup.triangles.size();
  const std::vector<Stack> stacks = findStacks(soup);
  if (stacks.empty()) return 0;
  std::vector<bool> isSpare(before, false);
  for (const Stack& stack : stacks) {
    for (const std::uint32_t t : stack.triangles) isSpare[t] = true;
    isSpare[keeper(soup, stack)] = false;
  }
  const std::vector<bool> isWall = findWalls(soup, stacks, isSpare);
  for (std::size_t s = 0; s < stacks.size(); ++s)
    if (isWall[s]) isSpare[keeper(soup, stacks[s])] = true;
  dropTriangles(soup, isSpare);
  return before - soup.triangles.size();
}

}  // namespace rubble::cooking
