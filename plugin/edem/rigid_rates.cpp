#include "edem/rigid_rates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edem/edge_points.h"
#include "edem/rigid_touch.h"

namespace rubble::edem {
namespace {

// A light rigid body at many elements is faster than they are: up to this multiple of their frequency^2 the
// substep follows it, beyond it its contacts are made softer; so are those where all contacts are.
constexpr double kLightBodyRate = 4;

// Bound from above of the largest eigenvalue of a matrix that has none below 0: the Frobenius norm of its
// fourth power, which is 6^(1/8) too large at most.
double largestEigenvalue(const Eigen::Matrix<double, 6, 6>& matrix) {
  const Eigen::Matrix<double, 6, 6> square = matrix * matrix, fourth = square * square;
  return std::pow(fourth.squaredNorm(), 0.125);
}

// Bound of what an impulse of 1 at a point of a rigid body moves that point by [1/kg]: 1/m + n.([r]^T I^-1
// [r]) n for the worst n. The point is one of the body's, and within `size` of `from`, world axes about its
// centre.
double mobilityAt(const RigidProxy& proxy, const Eigen::Vector3d& from, double size) {
  const Eigen::Vector3d& turns = proxy.inverseInertia;
  const double reach = proxy.reach(), lever2 = std::min(from.squaredNorm(), reach * reach);
  if (proxy.mobility) {
    const double lever = std::min(from.norm() + size, reach);
    // Both shares at once where they go together: (a + b)^2 is 2 (a^2 + b^2) at most.
    const double together = proxy.mobility->topRightCorner<3, 3>().isZero(0) ? 1 : 2;
    return together * double(1 + proxy.coupled.size()) *
           (proxy.inverseMass + lever * lever * turns.maxCoeff());
  }
  // What is long and narrow turns easily about its axis alone, and near it: by the trace of that matrix.
  Eigen::AlignedBox3d all;
  for (const Collider& part : proxy.parts) all.extend(part.bounds());
  const Eigen::Vector3d at = proxy.orientation.conjugate() * from,
                        furthest = all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs());
  const Eigen::Vector3d r2 = (at.cwiseAbs().array() + size).matrix().cwiseMin(furthest).cwiseAbs2();
  const double trace = turns.dot(Eigen::Vector3d::Constant(r2.sum()) - r2);
  return proxy.inverseMass + std::min(lever2 * turns.maxCoeff(), trace);
}

}  // namespace

template <class Real>
void weighFaces(RigidContact& c, const Body<Real>& body, const RigidProxy& proxy, FaceTouch& faces) {
  const std::uint32_t i = c.element;
  const CellFaces& cells = *body.constants->cells;
  c.exposed = body.state.exposure.area[i];
  c.weight = c.mode = c.dampingWeight = 0;
  const double gyration = body.constants->inertia[i] / body.constants->mass[i];
  const auto add = [&](double weight, double lever2) {
    c.weight += weight;
    c.mode += weight * (1 + lever2 / gyration);
    c.dampingWeight += weight * std::sqrt(1 + lever2 / gyration);
  };
  if (c.core) add(1, 0);
  c.lone = 1;
  if (!(c.exposed > 0)) return;
  add(c.balls, cells.reach[i] * cells.reach[i]);
  const ElementPose pose = poseOf(body, i, proxy);
  faces.approach(proxy, pose.at, std::numeric_limits<double>::infinity());
  // Stiffness of the points against shifts and turns of the element, for a mass and an inertia of 1.
  Eigen::Matrix<double, 6, 6> stiff = Eigen::Matrix<double, 6, 6>::Zero(), damped = stiff;
  double pressed = 0;
  faces.visitFacing(cells, body.state.exposure, i, pose,
                    [&](double weight, const Eigen::Vector3d& normal, const Eigen::Vector3d& lever) {
                      Eigen::Matrix<double, 6, 1> way;
                      way << normal, lever / std::sqrt(gyration);
                      stiff += weight * way * way.transpose();
                      damped += weight / way.norm() * way * way.transpose();
                      pressed += weight;
                    });
  c.weight += pressed;
  c.mode += largestEigenvalue(stiff);
  c.dampingWeight += largestEigenvalue(damped);
  c.lone = std::max({c.lone, c.balls, pressed});
}

template <class Real>
ElementRates ratesOf(const RigidContact& c, const Body<Real>& body, const ContactLaw<double>& law,
                     double& frequency2) {
  const double moves = 1 / body.constants->mass[c.element], turns = 1 / body.constants->inertia[c.element];
  if (!body.constants->cells) {
    frequency2 = law.stiffness * moves;
    return contactRates(law, moves, turns, double(body.constants->radius));
  }
  if (!(c.weight > 0)) return {};
  frequency2 = c.lone * law.stiffness * moves;
  const double reach = body.constants->cells->reach[c.element], sliding = moves + reach * reach * turns;
  return {
      law.stiffness * c.mode * moves + law.tangential * sliding + law.rolling * turns,
      law.damping * c.dampingWeight * moves + law.tangentialDamping * sliding + law.rollingDamping * turns};
}

// An impulse J at a point r from the centre moves that point by at most (1/m + r^2 / I) J.
template <class Real>
void addMobility(RigidContact& c, const Body<Real>& body, const RigidProxy& proxy, RigidState& state) {
  if (!(c.weight > 0) || !proxy.isDynamic()) return;
  const Eigen::Vector3d x = body.state.origin + body.work.position[c.element];
  const double mobility = mobilityAt(
      proxy, x - proxy.position,
      body.constants->cells ? body.constants->cells->reach[c.element] : double(body.constants->radius));
  c.mobility = mobility;
  state.mobility += mobility;
  state.rate += (c.weight - c.edges) * mobility * body.constants->contact.stiffness;
  if (!(c.edges > 0)) return;
  const double rate = mobility * body.constants->contact.stiffness;
  state.edgeRate += c.edges * rate;
  state.edgeMost = std::max(state.edgeMost, rate / std::sqrt(body.constants->cells->unit));
}

void addEdges(const RigidProxy& proxy, RigidState& state) {
  if (state.edgeRate > 0) state.rate += std::min(state.edgeRate, edgeWeight(proxy) * state.edgeMost);
}

void setLaws(std::span<const ContactSide> sides, const RigidProxy& proxy, double frequency2, double share,
             RigidState& state) {
  const double allowed = kLightBodyRate * share * frequency2;
  if (share * state.rate > allowed) share = allowed / state.rate;
  state.laws.clear();
  state.rates = {share * state.rate, 0};
  for (ContactSide side : sides) {
    const double friction = side.friction < 0 ? side.friction : side.friction * proxy.friction;
    side.stiffness *= share;
    ContactSide rigid = side;
    rigid.mobility = state.mobility;
    rigid.turning = rigid.radius = 0;
    rigid.restitution = proxy.restitution;
    state.laws.push_back(contactLaw(side, rigid));
    state.laws.back().friction = friction;
    const ContactLaw<double>& law = state.laws.back();
    state.rates.damping =
        std::max(state.rates.damping, state.mobility * std::max(law.damping, law.tangentialDamping));
  }
}

template void weighFaces(RigidContact&, const Body<float>&, const RigidProxy&, FaceTouch&);
template void weighFaces(RigidContact&, const Body<double>&, const RigidProxy&, FaceTouch&);
template ElementRates ratesOf(const RigidContact&, const Body<float>&, const ContactLaw<double>&, double&);
template ElementRates ratesOf(const RigidContact&, const Body<double>&, const ContactLaw<double>&, double&);
template void addMobility(RigidContact&, const Body<float>&, const RigidProxy&, RigidState&);
template void addMobility(RigidContact&, const Body<double>&, const RigidProxy&, RigidState&);

}  // namespace rubble::edem
