#include "bullet/contact_patch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Points whose polygon is thinner than this share of its length are a line.
constexpr double kThin = 1e-3;

struct Pressed {
  Eigen::Vector3d at, force;
  double press;
};

std::vector<Pressed> pressedPoints(const btPersistentManifold& manifold, bool second,
                                   const Eigen::Isometry3d& frame, double dt) {
  const Eigen::Isometry3d into = frame.inverse();
  std::vector<Pressed> out;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& p = manifold.getContactPoint(i);
    if (!(p.m_appliedImpulse > 0)) continue;
    const btVector3 onFirst = p.m_appliedImpulse * p.m_normalWorldOnB +
                              p.m_appliedImpulseLateral1 * p.m_lateralFrictionDir1 +
                              p.m_appliedImpulseLateral2 * p.m_lateralFrictionDir2;
    const Eigen::Vector3d force = (second ? -1 : 1) / dt * (into.linear() * toEigen(onFirst));
    const btVector3& at = second ? p.getPositionWorldOnB() : p.getPositionWorldOnA();
    out.push_back({into * toEigen(at), force, double(p.m_appliedImpulse) / dt});
  }
  return out;
}

// Around their middle as seen along the normal; those of a line by its ends alone.
void orderCorners(std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& normal, double& area) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& p : corners) middle += p / double(corners.size());
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto angle = [&](const Eigen::Vector3d& p) {
    return std::atan2(v.dot(p - middle), u.dot(p - middle));
  };
  std::sort(corners.begin(), corners.end(),
            [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 2> ends = {corners[0], corners[0]};
  for (const auto& p : corners) {
    for (const auto& q : corners)
      if ((p - q).squaredNorm() > (ends[0] - ends[1]).squaredNorm()) ends = {p, q};
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  area = 0.5 * twice.norm();
  if (area > kThin * (ends[0] - ends[1]).squaredNorm()) return;
  area = 0;
  corners = {ends[0], ends[1]};
}

Eigen::Vector3d centroidOf(const std::vector<Eigen::Vector3d>& corners, double area) {
  if (!(area > 0)) return 0.5 * (corners.front() + corners.back());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const double weight = (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).norm();
    sum += weight / 3 * (corners[0] + corners[i] + corners[i + 1]);
    weights += weight;
  }
  return sum / weights;
}

// How large a copy about `middle` is still inside the corners' polygon, 0 to 1.
double shrunk(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& centroid,
              const Eigen::Vector3d& middle) {
  double share = 1;
  const std::size_t n = corners.size();
  if (n == 2) {
    const double half = 0.5 * (corners[1] - corners[0]).norm();
    return half > 0 ? std::clamp(1 - (middle - centroid).norm() / half, 0.0, 1.0) : 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d &p = corners[i], edge = (corners[(i + 1) % n] - p).normalized();
    const Eigen::Vector3d inward = (centroid - p) - edge.dot(centroid - p) * edge;
    const double far = inward.norm();
    if (far > 0) share = std::min(share, inward.dot(middle - p) / (far * far));
  }
  return std::clamp(share, 0.0, 1.0);
}

// Share of the corners' polygon or line beyond the cut, and its middle.
struct Part {
  double share = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

Part partBeyond(const ContactPatch& patch, const Section& cut) {
  const auto depth = [&](const Eigen::Vector3d& p) { return p[cut.axis] - cut.at; };
  const std::size_t n = patch.corners.size();
  const auto inside = std::count_if(patch.corners.begin(), patch.corners.end(),
                                    [&](const Eigen::Vector3d& p) { return depth(p) > 0; });
  if (inside == 0) return {};
  if (std::size_t(inside) == n) return {1, patch.middle};
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i) {
    const Eigen::Vector3d &p = patch.corners[i], &q = patch.corners[(i + 1) % n];
    const double a = depth(p), b = depth(q);
    if (a > 0) kept.push_back(p);
    if ((a > 0) != (b > 0)) kept.push_back(p + a / (a - b) * (q - p));
    if (n == 2 && b > 0) kept.push_back(q);
  }
  if (n == 2) {
    const double whole = (patch.corners[1] - patch.corners[0]).norm();
    return {(kept.back() - kept.front()).norm() / whole, 0.5 * (kept.front() + kept.back())};
  }
  double twice = 0;
  for (std::size_t i = 1; i + 1 < kept.size(); ++i)
    twice += (kept[i] - kept[0]).cross(kept[i + 1] - kept[0]).norm();
  if (!(twice > 0)) return {};
  return {0.5 * twice / patch.area, centroidOf(kept, 0.5 * twice)};
}

}  // namespace

Wrench ContactPatch::beyond(const Section& cut) const {
  const Part part = partBeyond(*this, cut);
  if (!(part.share > 0)) return {};
  const Eigen::Vector3d couple = load.moment - middle.cross(load.force);
  return {part.share * load.force, part.share * (part.middle.cross(load.force) + couple)};
}

std::optional<ContactPatch> contactPatch(const btPersistentManifold& manifold, bool second,
                                         const Eigen::Isometry3d& frame, double dt) {
  const std::vector<Pressed> points = pressedPoints(manifold, second, frame, dt);
  if (points.empty()) return std::nullopt;
  ContactPatch patch;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Pressed& p : points) {
    patch.press += p.press;
    patch.middle += p.press * p.at;
    patch.load += {p.force, p.at.cross(p.force)};
    normal += p.force;
  }
  patch.middle /= patch.press;
  // All that touches, pressed or not: one point may carry what is spread over all.
  const Eigen::Isometry3d into = frame.inverse();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& p = manifold.getContactPoint(i);
    patch.corners.push_back(into * toEigen(second ? p.getPositionWorldOnB() : p.getPositionWorldOnA()));
  }
  if (patch.corners.size() > 1) {
    orderCorners(patch.corners, normal.normalized(), patch.area);
    const Eigen::Vector3d centroid = centroidOf(patch.corners, patch.area);
    const double share = shrunk(patch.corners, centroid, patch.middle);
    for (auto& p : patch.corners) p = patch.middle + share * (p - centroid);
    patch.area *= share * share;
    if (!(share > 0)) patch.corners = {patch.middle};
  }
  const std::size_t n = patch.corners.size();
  for (std::size_t i = 0; i < n && n > 1; ++i)
    patch.halfRim += 0.5 * (patch.corners[(i + 1) % n] - patch.corners[i]).norm();
  return patch;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
