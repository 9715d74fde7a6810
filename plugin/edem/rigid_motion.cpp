#include "edem/rigid_motion.h"

#include <ranges>

namespace rubble::edem {
namespace {

// Of those of the elements that live and that groupOf(element) gives one number.
template <class Real, class Elements, class GroupOf>
std::map<std::uint32_t, RigidMotion> motionsOf(const Body<Real>& body, const Elements& elements,
                                               GroupOf&& groupOf) {
  std::map<std::uint32_t, RigidMotion> motions;
  const auto each = [&](auto&& visit) {
    for (const std::size_t i : elements)
      if (body.alive[i]) visit(i, motions[groupOf(i)]);
  };
  each([&](std::size_t i, RigidMotion& m) {
    m.mass += body.mass[i];
    m.centre += body.mass[i] * body.worldPosition(i);
    m.velocity += body.mass[i] * body.velocity[i].template cast<double>();
  });
  for (auto& [root, m] : motions) {
    m.centre /= m.mass;
    m.velocity /= m.mass;
  }
  each([&](std::size_t i, RigidMotion& m) {
    const Eigen::Vector3d arm = body.worldPosition(i) - m.centre;
    const Eigen::Vector3d v = body.velocity[i].template cast<double>() - m.velocity;
    m.angular += body.mass[i] * arm.cross(v) + body.inertia[i] * body.spin[i].template cast<double>();
    m.inertia += body.mass[i] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose()) +
                 body.inertia[i] * Eigen::Matrix3d::Identity();
  });
  for (auto& [root, m] : motions) m.spin = m.inertia.ldlt().solve(m.angular);
  return motions;
}

}  // namespace

template <class Real>
std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<Real>& body) {
  return motionsOf(body, body.awake, [&](std::size_t i) { return body.fragment[i]; });
}

template <class Real>
RigidMotion wholeMotion(const Body<Real>& body) {
  const auto motions =
      motionsOf(body, std::views::iota(std::size_t(0), body.elementCount()), [](std::size_t) { return 0u; });
  return motions.empty() ? RigidMotion{} : motions.begin()->second;
}

template std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<float>&);
template std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<double>&);
template RigidMotion wholeMotion(const Body<float>&);
template RigidMotion wholeMotion(const Body<double>&);

}  // namespace rubble::edem
