#include "cook/triangle_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>

namespace rubble::cooking {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kDeepest = 64;            // halving 2^32 pieces gives 32 levels
constexpr std::size_t kPiecesPerTriangle = 64;  // on average, at most
constexpr std::size_t kMostSplits = 1 << 18;    // 30 MB
constexpr double kSmallBox = 1.0 / 65536;       // of the surface of the mesh's bounds; not split further

// Some corners of a triangle, on the way to pieces.
struct Part {
  std::array<Eigen::Vector3d, 3> corners;
  std::uint32_t triangle;
  double size;  // of the surface of its box [m^2]

  Eigen::AlignedBox3d box() const {
    Eigen::AlignedBox3d result;
    for (const Eigen::Vector3d& corner : corners) result.extend(corner);
    return result;
  }
};

double surfaceOf(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d s = box.sizes();
  return 2 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
}

Part partOf(const std::array<Eigen::Vector3d, 3>& corners, std::uint32_t triangle) {
  Part part{corners, triangle, 0};
  part.size = surfaceOf(part.box());
  return part;
}

// Both halves of a part, cut through the middle of its longest edge.
std::array<Part, 2> halves(const Part& part) {
  std::size_t longest = 0;
  const auto length = [&part](std::size_t k) {
    return (part.corners[(k + 1) % 3] - part.corners[k]).squaredNorm();
  };
  for (const std::size_t k : {1u, 2u})
    if (length(k) > length(longest)) longest = k;
  const Eigen::Vector3d& a = part.corners[longest];
  const Eigen::Vector3d& b = part.corners[(longest + 1) % 3];
  const Eigen::Vector3d& c = part.corners[(longest + 2) % 3];
  const Eigen::Vector3d middle = (a + b) / 2;
  return {partOf({a, middle, c}, part.triangle), partOf({middle, b, c}, part.triangle)};
}

// Whether the line (y, z) along x passes on the left of the edge a-b, in the yz plane. Both triangles at the
// edge ask with the same order of ends and so get the same answer: no ray slips between them.
bool edgeCrossed(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double y, double z) {
  if ((a.z() > z) == (b.z() > z)) return false;
  return y < a.y() + (z - a.z()) / (b.z() - a.z()) * (b.y() - a.y());
}

// From the box, 0 inside it.
double squaredDistance(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beside = std::max({box.min()[axis] - place[axis], place[axis] - box.max()[axis], 0.0});
    sum += beside * beside;
  }
  return sum;
}

}  // namespace

Eigen::Matrix3d axesAlongEdges(const CheckedMesh& mesh) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& [a, b] : mesh.edges) {
    const Eigen::Vector3d edge = (mesh.vertices[b] - mesh.vertices[a]) / mesh.diagonal();
    sum += edge.norm() * edge * edge.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().transpose();
}

Eigen::Vector3d closestOnTriangle(const Eigen::Vector3d& place, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double abA = ab.dot(place - a);
  const double acA = ac.dot(place - a);
  if (abA <= 0 && acA <= 0) return a;
  const double abB = ab.dot(place - b);
  const double acB = ac.dot(place - b);
  if (abB >= 0 && acB <= abB) return b;
  const double besideAb = abA * acB - abB * acA;
  if (besideAb <= 0 && abA >= 0 && abB <= 0 && abA > abB) return a + abA / (abA - abB) * ab;
  const double abC = ab.dot(place - c);
  const double acC = ac.dot(place - c);
  if (acC >= 0 && abC <= acC) return c;
  const double besideAc = abC * acA - abA * acC;
  if (besideAc <= 0 && acA >= 0 && acC <= 0 && acA > acC) return a + acA / (acA - acC) * ac;
  const double besideBc = abB * acC - abC * acB;
  const double alongB = acB - abB;
  const double alongC = abC - acC;
  if (besideBc <= 0 && alongB >= 0 && alongC >= 0 && alongB + alongC > 0)
    return b + alongB / (alongB + alongC) * (c - b);
  const double sum = besideAb + besideAc + besideBc;
  if (!(sum > 0)) return a;  // no area and none of the cases above
  return a + besideAc / sum * ab + besideAb / sum * ac;
}

TriangleTree::TriangleTree(const CheckedMesh& mesh) : m_mesh(mesh), m_turn(axesAlongEdges(mesh)) {
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    m_vertices.emplace_back(m_turn * vertex);
    m_bounds.extend(m_vertices.back());
  }
  for (const auto& [a, b, c] : mesh.triangles)
    m_corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  std::vector<Piece> pieces = split();
  m_nodes.reserve(pieces.size());
  build(pieces, 0, std::uint32_t(pieces.size()));
  m_order.reserve(pieces.size());
  for (const Piece& piece : pieces) m_order.push_back(piece.triangle);
}

// Halves the parts with the largest boxes until all are small or there are enough.
std::vector<TriangleTree::Piece> TriangleTree::split() const {
  const std::size_t count = m_mesh.triangles.size();
  const std::size_t most = count + std::min(kMostSplits, (kPiecesPerTriangle - 1) * count);
  const double small = kSmallBox * surfaceOf(m_bounds);
  // The middle of an edge is rounded, and so are turned vertices.
  const Eigen::Vector3d rounding = 4 * std::numeric_limits<double>::epsilon() *
                                   m_bounds.min().cwiseAbs().cwiseMax(m_bounds.max().cwiseAbs());
  std::vector<Piece> pieces;
  pieces.reserve(count);
  const auto keep = [&pieces, &rounding](const Part& part) {
    const Eigen::AlignedBox3d box = part.box();
    pieces.push_back({{box.min() - rounding, box.max() + rounding}, part.triangle});
  };
  const auto isSmaller = [](const Part& a, const Part& b) { return a.size < b.size; };
  std::priority_queue<Part, std::vector<Part>, decltype(isSmaller)> large(isSmaller);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = m_mesh.triangles[t];
    const Part part = partOf({m_vertices[a], m_vertices[b], m_vertices[c]}, t);
    if (part.size > small) {
      large.push(part);
    } else {
      keep(part);
    }
  }
  for (; !large.empty() && large.size() + pieces.size() < most;) {
    const Part part = large.top();
    large.pop();
    for (const Part& half : halves(part)) {
      if (half.size > small) {
        large.push(half);
      } else {
        keep(half);
      }
    }
  }
  for (; !large.empty(); large.pop()) keep(large.top());
  return pieces;
}

void TriangleTree::build(std::vector<Piece>& pieces, std::uint32_t first, std::uint32_t count) {
  const std::size_t node = m_nodes.size();
  m_nodes.push_back({{}, first, count});
  Eigen::AlignedBox3d centres;
  for (std::uint32_t k = first; k < first + count; ++k) {
    m_nodes[node].box.extend(pieces[k].box);
    centres.extend(pieces[k].box.center());
  }
  if (count <= kLeafSize) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto begin = pieces.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Piece& s, const Piece& t) {
    const double atS = s.box.min()[axis] + s.box.max()[axis];
    const double atT = t.box.min()[axis] + t.box.max()[axis];
    return atS != atT ? atS < atT : s.triangle < t.triangle;
  });
  build(pieces, first, count / 2);
  m_nodes[node].first = std::uint32_t(m_nodes.size());
  m_nodes[node].count = 0;
  build(pieces, first + count / 2, count - count / 2);
}

TriangleTree::Closest TriangleTree::closest(const Eigen::Vector3d& place, double reach, double slack) const {
  const Eigen::Vector3d turned = m_turn * place;
  Closest best{place, kNoElement, reach * reach};
  const auto tryOne = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = m_corners[triangle];
    const Eigen::Vector3d point = closestOnTriangle(place, a, b, c);
    const double distance = (point - place).squaredNorm();
    if (distance < best.squaredDistance || (distance == best.squaredDistance && triangle < best.triangle))
      best = {point, triangle, distance};
    ++m_trianglesTried;
  };
  const double shorter = 1 / ((1 + slack) * (1 + slack));
  struct Waiting {
    std::uint32_t node;
    double squaredDistance;
  };
  std::array<Waiting, kDeepest> stack;
  std::size_t depth = 1;
  stack[0] = {0, squaredDistance(m_nodes[0].box, turned)};
  std::uint32_t last = kNoElement;
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.squaredDistance > best.squaredDistance * shorter) continue;
    const Node& node = m_nodes[next.node];
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t triangle = m_order[k];
      if (triangle == last || triangle == best.triangle) continue;  // another part of it was met before
      tryOne(triangle);
      last = triangle;
    }
    if (node.count > 0) continue;
    const Waiting left{next.node + 1, squaredDistance(m_nodes[next.node + 1].box, turned)};
    const Waiting right{node.first, squaredDistance(m_nodes[node.first].box, turned)};
    const bool leftIsNearer = left.squaredDistance <= right.squaredDistance;
    stack[depth++] = leftIsNearer ? right : left;
    stack[depth++] = leftIsNearer ? left : right;
  }
  return best;
}

bool TriangleTree::crossesLine(std::uint32_t triangle, double y, double z) const {
  bool crosses = false;
  for (const std::uint32_t edge : m_mesh.triangleEdges[triangle]) {
    const auto& [a, b] = m_mesh.edges[edge];
    crosses = crosses != edgeCrossed(m_vertices[a], m_vertices[b], y, z);
  }
  return crosses;
}

// Where a line that crosses the triangle meets its plane; a triangle edge-on to it answers with its middle.
double TriangleTree::crossing(std::uint32_t triangle, double y, double z) const {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t v : m_mesh.triangles[triangle]) box.extend(m_vertices[v]);
  const Eigen::Vector3d normal = m_turn * m_mesh.normals[triangle];
  const Eigen::Vector3d& corner = m_vertices[m_mesh.triangles[triangle][0]];
  const double slope = normal.y() * (y - corner.y()) + normal.z() * (z - corner.z());
  const double x = normal.x() != 0 ? corner.x() - slope / normal.x() : box.center().x();
  return std::clamp(x, box.min().x(), box.max().x());
}

bool TriangleTree::holds(const Eigen::Vector3d& asked) const {
  const Eigen::Vector3d place = m_turn * asked;
  const auto meets = [&place](const Eigen::AlignedBox3d& box) {
    return box.max().x() >= place.x() && box.min().y() <= place.y() && place.y() <= box.max().y() &&
           box.min().z() <= place.z() && place.z() <= box.max().z();
  };
  std::vector<std::uint32_t> crossed;
  std::array<std::uint32_t, kDeepest> stack{};
  for (std::size_t depth = 1; depth > 0;) {
    const std::uint32_t index = stack[--depth];
    const Node& node = m_nodes[index];
    if (!meets(node.box)) continue;
    m_trianglesTried += node.count;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (crossesLine(m_order[k], place.y(), place.z()) &&
          crossing(m_order[k], place.y(), place.z()) > place.x())
        crossed.push_back(m_order[k]);
    if (node.count > 0) continue;
    stack[depth++] = node.first;
    stack[depth++] = index + 1;
  }
  // Several parts of one triangle may have been met.
  std::sort(crossed.begin(), crossed.end());
  return (std::unique(crossed.begin(), crossed.end()) - crossed.begin()) % 2 != 0;
}

}  // namespace rubble::cooking
