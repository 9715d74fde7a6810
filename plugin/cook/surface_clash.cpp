#include "cook/surface_clash.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "cook/box_pairs.h"
#include "cook/triangle_tree.h"

namespace rubble::cooking {
namespace {

// Comparisons of boxes before the search is given up: about a second.
constexpr std::size_t kMostBoxTests = 150'000'000;

using Corners = std::array<Eigen::Vector3d, 3>;

// About the middle of the mesh, where doubles are finest.
class ClashSearch {
 public:
  ClashSearch(const CheckedMesh& mesh, double depth)
      : m_mesh(mesh), m_middle(mesh.bounds.center()), m_depth(depth) {}

  // The worst is the least.
  std::optional<Clash> run(Clash::Kind mildest) {
    m_mildest = mildest;
    visitOverlaps(boxes(), kMostBoxTests, [this](std::uint32_t s, std::uint32_t t) { judge(s, t); });
    if (m_worst) m_worst->place += m_middle;
    return m_worst;
  }

 private:
  Corners cornersOf(std::uint32_t t) const {
    const auto& [a, b, c] = m_mesh.triangles[t];
    return {m_mesh.vertices[a] - m_middle, m_mesh.vertices[b] - m_middle, m_mesh.vertices[c] - m_middle};
  }

  // In axes along the long edges, or in those of the mesh where these are better.
  std::vector<Eigen::AlignedBox3d> boxes() const {
    const Eigen::Matrix3d turn = axesAlongEdges(m_mesh);
    std::vector<Eigen::AlignedBox3d> plain, turned;
    double plainSize = 0, turnedSize = 0;
    for (std::uint32_t t = 0; t < m_mesh.triangles.size(); ++t) {
      Eigen::AlignedBox3d p, q;
      for (const Eigen::Vector3d& corner : cornersOf(t)) {
        p.extend(corner);
        q.extend(turn * corner);
      }
      plainSize += p.diagonal().sum() * p.diagonal().sum() - p.diagonal().squaredNorm();  // its surface
      turnedSize += q.diagonal().sum() * q.diagonal().sum() - q.diagonal().squaredNorm();
      plain.push_back(p);
      turned.push_back(q);
    }
    std::vector<Eigen::AlignedBox3d>& best = turnedSize < plainSize ? turned : plain;
    // Turned corners are rounded, and sheets in the same place may miss each other by a rounding.
    for (Eigen::AlignedBox3d& box : best) {
      box.min().array() -= m_depth;
      box.max().array() += m_depth;
    }
    return std::move(best);
  }

  void judge(std::uint32_t s, std::uint32_t t) {
    const auto& one = m_mesh.triangles[s];
    const auto& other = m_mesh.triangles[t];
    int shared = 0;
    for (const std::uint32_t v : one) shared += std::count(other.begin(), other.end(), v) > 0 ? 1 : 0;
    if (shared == 2) return;  // neighbours, or as good as that
    const Corners a = cornersOf(s), b = cornersOf(t);
    const Eigen::Vector3d &toA = m_mesh.normals[s], &toB = m_mesh.normals[t];
    const Eigen::Vector3d over = heights(b, a[0], toA);
    if (over.minCoeff() > m_depth || over.maxCoeff() < -m_depth) return;
    const Eigen::Vector3d under = heights(a, b[0], toB);
    if (under.minCoeff() > m_depth || under.maxCoeff() < -m_depth) return;
    if (over.cwiseAbs().maxCoeff() <= m_depth && under.cwiseAbs().maxCoeff() <= m_depth) {
      const auto kind = toA.dot(toB) > 0 ? Clash::Kind::Doubled : Clash::Kind::Touching;
      if (kind <= m_mildest)
        if (const auto place = overlap(a, toA, b)) tell({kind, {s, t}, *place});
    } else if (shared < 2) {
      auto place = piercing(a, b, toB, under);
      if (!place) place = piercing(b, a, toA, over);
      if (place) tell({Clash::Kind::Crossing, {s, t}, *place});
    }
  }

  void tell(const Clash& clash) {
    const auto key = [](const Clash& c) { return std::tuple(c.kind, c.triangles); };
    if (!m_worst || key(clash) < key(*m_worst)) m_worst = clash;
  }

  static Eigen::Vector3d heights(const Corners& corners, const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& normal) {
    return {(corners[0] - origin).dot(normal), (corners[1] - origin).dot(normal),
            (corners[2] - origin).dot(normal)};
  }

  // How far a place in the plane of a triangle is from its nearest side; outside below 0.
  static double insideBy(const Corners& triangle, const Eigen::Vector3d& normal,
                         const Eigen::Vector3d& place) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d side = triangle[(k + 1) % 3] - triangle[k];
      least = std::min(least, normal.dot(side.cross(place - triangle[k])) / side.norm());
    }
    return least;
  }

  // Where an edge of one triangle, whose corners are `heights` over the other, goes through that.
  std::optional<Eigen::Vector3d> piercing(const Corners& edges, const Corners& other,
                                          const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& heights) const {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double from = heights[k], to = heights[(k + 1) % 3];
      if (!(std::min(from, to) < -m_depth && std::max(from, to) > m_depth)) continue;
      const Eigen::Vector3d &p = edges[std::size_t(k)], &q = edges[std::size_t(k + 1) % 3];
      const Eigen::Vector3d place = p + from / (from - to) * (q - p);
      if (insideBy(other, normal, place) > m_depth) return place;
    }
    return std::nullopt;
  }

  // The middle of what two triangles in a plane have in common, where that is wide enough.
  std::optional<Eigen::Vector3d> overlap(const Corners& a, const Eigen::Vector3d& normal,
                                         const Corners& b) const {
    std::vector<Eigen::Vector3d> common(b.begin(), b.end()), kept;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d inwards = normal.cross(a[(k + 1) % 3] - a[k]).normalized();
      const auto inside = [&](const Eigen::Vector3d& p) { return inwards.dot(p - a[k]); };
      kept.clear();
      for (std::size_t i = 0; i < common.size(); ++i) {
        const Eigen::Vector3d &p = common[i], &q = common[(i + 1) % common.size()];
        const double from = inside(p), to = inside(q);
        if (from > 0) kept.push_back(p);
        if ((from > 0) != (to > 0)) kept.emplace_back(p + from / (from - to) * (q - p));
      }
      common.swap(kept);
    }
    if (common.size() < 3) return std::nullopt;
    Eigen::Vector3d twice = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
    double around = 0;
    for (std::size_t i = 0; i < common.size(); ++i) {
      const Eigen::Vector3d &p = common[i], &q = common[(i + 1) % common.size()];
      twice += (p - common[0]).cross(q - common[0]);
      around += (q - p).norm();
      middle += p / double(common.size());
    }
    if (!(twice.norm() > m_depth * around)) return std::nullopt;
    return middle;
  }

  const CheckedMesh& m_mesh;
  const Eigen::Vector3d m_middle;
  const double m_depth;
  Clash::Kind m_mildest = Clash::Kind::Doubled;
  std::optional<Clash> m_worst;
};

}  // namespace

std::optional<Clash> findClash(const CheckedMesh& mesh, double depth) {
  return ClashSearch(mesh, depth).run(Clash::Kind::Doubled);
}

std::optional<Clash> findContact(const CheckedMesh& mesh, double depth) {
  return ClashSearch(mesh, depth).run(Clash::Kind::Touching);
}

}  // namespace rubble::cooking
