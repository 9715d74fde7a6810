#include "edem/rigid_motion.h"

#include <ranges>

namespace rubble::edem {
namespace {

template <class Real>
bool belongs(const Body<Real>& body, std::size_t i, std::uint32_t root) {
  return body.state.alive[i] && (root == kNoElement || body.state.fragment[i] == root);
}

// Of those of the elements that `isIn` takes and that groupOf(element) gives one number.
template <class Real, class Elements, class IsIn, class GroupOf>
std::map<std::uint32_t, RigidMotion> motionsOf(const Body<Real>& body, const Elements& elements, IsIn&& isIn,
                                               GroupOf&& groupOf) {
  std::map<std::uint32_t, RigidMotion> motions;
  const auto each = [&](auto&& visit) {
    for (const std::size_t i : elements)
      if (isIn(i)) visit(i, motions[groupOf(i)]);
  };
  each([&](std::size_t i, RigidMotion& m) {
    m.mass += body.constants->mass[i];
    m.centre += body.constants->mass[i] * body.worldPosition(i);
    m.velocity += body.constants->mass[i] * body.state.velocity[i].template cast<double>();
  });
  for (auto& [group, m] : motions) {
    m.centre /= m.mass;
    m.velocity /= m.mass;
  }
  each([&](std::size_t i, RigidMotion& m) {
    const Eigen::Vector3d arm = body.worldPosition(i) - m.centre;
    const Eigen::Vector3d v = body.state.velocity[i].template cast<double>() - m.velocity;
    m.angular += body.constants->mass[i] * arm.cross(v) +
                 body.constants->inertia[i] * body.state.spin[i].template cast<double>();
    m.inertia +=
        body.constants->mass[i] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose()) +
        body.constants->inertia[i] * Eigen::Matrix3d::Identity();
  });
  for (auto& [group, m] : motions) m.spin = m.inertia.ldlt().solve(m.angular);
  return motions;
}

}  // namespace

template <class Real>
std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<Real>& body) {
  return motionsOf(
      body, body.work.awake, [&](std::size_t i) { return body.state.alive[i] != 0; },
      [&](std::size_t i) { return body.state.fragment[i]; });
}

template <class Real>
RigidMotion wholeMotion(const Body<Real>& body, std::uint32_t root) {
  const auto motions = motionsOf(
      body, std::views::iota(std::size_t(0), body.elementCount()),
      [&](std::size_t i) { return belongs(body, i, root); }, [](std::size_t) { return 0u; });
  return motions.empty() ? RigidMotion{} : motions.begin()->second;
}

template <class Real>
Placement placementOf(const Body<Real>& body, std::uint32_t root) {
  Placement p;
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!belongs(body, i, root)) continue;
    p.mass += body.constants->mass[i];
    p.centre += body.constants->mass[i] * body.worldPosition(i);
    p.restCentre += body.constants->mass[i] * body.constants->asset->positions[i];
    p.anchored = p.anchored || body.state.anchored[i];
    const Eigen::Vector4d q = body.orientation(i).coeffs();
    turn += (q.dot(turn) < 0 ? -body.constants->mass[i] : body.constants->mass[i]) * q;
  }
  if (!(p.mass > 0)) return p;
  p.centre /= p.mass;
  p.restCentre /= p.mass;
  p.place.linear() = Eigen::Quaterniond(Eigen::Vector4d(turn.normalized())).toRotationMatrix();
  p.place.translation() = p.centre - p.place.linear() * p.restCentre;
  return p;
}

template std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<float>&);
template std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<double>&);
template RigidMotion wholeMotion(const Body<float>&, std::uint32_t);
template RigidMotion wholeMotion(const Body<double>&, std::uint32_t);
template Placement placementOf(const Body<float>&, std::uint32_t);
template Placement placementOf(const Body<double>&, std::uint32_t);

}  // namespace rubble::edem
