#include "edem/prestress.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "edem/rest_solver.h"

namespace rubble::edem {
namespace {

using Eigen::VectorXd;

// Below, a sparse Cholesky takes milliseconds, and is exact where conjugate gradients are slow (chains).
constexpr std::size_t kDirectElements = 256;
// Each gains several digits at the strains of a standing object; one near buckling needs many.
constexpr int kMostCorrections = 50;
// A correction that leaves more than this share of the residual calls for the stiffness of the present state:
// a slender body that bends by some degrees has another one than at rest.
constexpr double kSlow = 0.3;
// Rotations since the stiffness was taken that change nothing in it [rad].
constexpr double kSameAngle = 1e-5;
// Part of a residual that the solver of one correction may leave; the next correction sees it again.
constexpr double kSolveShare = 1e-3;

constexpr const char* kIndefinite = "its stiffness is not positive definite";

std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string text(const char* format, ...) {
  char line[256];
  va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof line, format, values);
  va_end(values);
  return line;
}

template <class Real>
bool everyFragmentAnchored(const Body<Real>& body) {
  std::vector<std::uint8_t> held(body.elementCount(), 0);
  for (std::size_t a = body.constants->anchorBegin; a < body.state.springs.size(); ++a)
    if (body.state.intact[a]) held[body.state.fragment[body.state.springs[a].first]] = 1;
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    if (body.state.alive[i] && !held[body.state.fragment[i]]) return false;
  return true;
}

// What the solution needs of a body, in double and in the asset's axes.
struct Problem {
  RestStiffness stiffness;
  std::vector<double> mass;  // [kg]; 0 for crushed elements
  double radius = 0;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  double size = 0;  // diagonal of the asset [m]
};

template <class Real>
Problem problemOf(const Body<Real>& body, const Eigen::Vector3d& gravity) {
  Problem p;
  p.stiffness.points = body.constants->restCentred;
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    if (!body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    p.stiffness.links.push_back({spring.first, body.isAnchor(s) ? kNoElement : spring.second,
                                 double(spring.stiffness), double(spring.rotational),
                                 body.constants->springRest[s], body.constants->springOffset[s],
                                 0.5 * body.constants->springRest[s] + body.constants->springOffset[s],
                                 0.5 * body.constants->springRest[s] - body.constants->springOffset[s]});
  }
  setShift(p.stiffness);
  p.mass = body.constants->mass;
  for (std::size_t i = 0; i < p.mass.size(); ++i)
    if (!body.state.alive[i]) p.mass[i] = 0;
  p.radius = double(body.constants->radius);
  p.gravity = gravity;
  p.size = body.constants->asset->diagonal();
  return p;
}

// Force and torque on every element in the given state, gravity included.
VectorXd residualForce(const Problem& p, const AssetRest& rest) {
  VectorXd force = VectorXd::Zero(6 * Eigen::Index(p.mass.size()));
  for (std::size_t i = 0; i < p.mass.size(); ++i)
    force.segment<3>(6 * Eigen::Index(i)) = p.mass[i] * p.gravity;
  for (const RestLink& l : p.stiffness.links) {
    Spring<double> spring{};
    spring.rest = l.rest;
    spring.offset = l.offset;
    spring.stiffness = l.stiffness;
    spring.rotational = l.rotational;
    const auto end = [&](std::uint32_t i) {
      SpringEnd<double> e;
      if (i == kNoElement) return e;
      e.displacement = rest.displacements[i];
      e.turn = rest.rotations[i];
      return e;
    };
    const SpringLoad<double> load = springLoad(spring, end(l.first), end(l.second));
    force.segment<3>(6 * Eigen::Index(l.first)) += load.elastic;
    force.segment<3>(6 * Eigen::Index(l.first) + 3) += load.armFirst.cross(load.elastic) + load.elasticTorque;
    if (l.second == kNoElement) continue;
    force.segment<3>(6 * Eigen::Index(l.second)) -= load.elastic;
    force.segment<3>(6 * Eigen::Index(l.second) + 3) +=
        load.armSecond.cross(load.elastic) - load.elasticTorque;
  }
  return force;
}

// NaN if anything is.
double worstOf(const Problem& p, const VectorXd& force) {
  if (!force.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  double worst = 0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (!(p.mass[i] > 0)) continue;
    const double weight = p.mass[i] * p.gravity.norm();
    const auto own = force.segment<6>(6 * Eigen::Index(i));
    worst = std::max({worst, own.head<3>().norm() / weight, own.tail<3>().norm() / (weight * p.radius)});
  }
  return worst;
}

struct Largest {
  double displacement = 0;  // of the state [m]
  double angle = 0;         // of the step [rad]
};

Largest advance(AssetRest& rest, const VectorXd& step) {
  Largest largest;
  for (std::size_t i = 0; i < rest.displacements.size(); ++i) {
    rest.displacements[i] += step.segment<3>(6 * Eigen::Index(i));
    largest.displacement = std::max(largest.displacement, rest.displacements[i].norm());
    const Eigen::Vector3d theta = step.segment<3>(6 * Eigen::Index(i) + 3);
    const double angle = theta.norm();
    largest.angle = std::max(largest.angle, angle);
    if (angle > 0)
      rest.rotations[i] =
          (Quat<double>(Eigen::AngleAxisd(angle, theta / angle)) * rest.rotations[i]).normalized();
  }
  return largest;
}

void turnHalves(RestStiffness& k, const AssetRest& rest) {
  for (RestLink& l : k.links) {
    const Eigen::Vector3d first = 0.5 * l.rest + l.offset, second = 0.5 * l.rest - l.offset;
    l.halfFirst = first + turned(rest.rotations[l.first], first);
    if (l.second != kNoElement) l.halfSecond = second + turned(rest.rotations[l.second], second);
  }
}

std::unique_ptr<RestSolver> solverOf(const Problem& p, RestMethod method) {
  const bool direct =
      method == RestMethod::Direct || (method == RestMethod::Chosen && p.mass.size() <= kDirectElements);
  return direct ? directSolver(p.stiffness) : groupedSolver(p.stiffness);
}

PrestressResult solve(Problem p, RestMethod method, AssetRest& rest) {
  PrestressResult result;
  result.outcome = PrestressOutcome::Failed;
  rest.displacements.assign(p.mass.size(), Eigen::Vector3d::Zero());
  rest.rotations.assign(p.mass.size(), Quat<double>::Identity());
  std::unique_ptr<RestSolver> solver = solverOf(p, method);
  if (!solver) {
    result.reason = kIndefinite;
    return result;
  }
  VectorXd force = residualForce(p, rest), step;
  result.residual = worstOf(p, force);
  double angle = 0;  // that the elements have turned since the stiffness was taken [rad]
  int before = 0;    // iterations of solvers that were given up
  while (!(result.residual <= kPrestressTolerance)) {
    if (result.corrections == kMostCorrections) {
      result.reason =
          text("%.3g of an element's weight is left unbalanced after %d corrections, allowed is %g",
               result.residual, kMostCorrections, kPrestressTolerance);
      return result;
    }
    ++result.corrections;
    const bool solved = solver->solve(force, kSolveShare, step);
    result.iterations = before + solver->iterations();
    if (!solved) {
      result.reason = text("its static state was not found in %d iterations", result.iterations);
      return result;
    }
    const Largest largest = advance(rest, step);
    if (!(largest.displacement <= p.size)) {
      result.reason = text(
          "under its weight its elements would move %.3g m, more than its size of %.3g m: it is too heavy "
          "for "
          "its stiffness",
          largest.displacement, p.size);
      return result;
    }
    force = residualForce(p, rest);
    const double last = std::exchange(result.residual, worstOf(p, force));
    angle += largest.angle;
    if (!(result.residual > kSlow * last) || angle < kSameAngle) continue;
    turnHalves(p.stiffness, rest);
    before = result.iterations;
    angle = 0;
    solver.reset();
    solver = solverOf(p, method);
    if (!solver) {
      result.reason = kIndefinite;
      return result;
    }
  }
  result.outcome = PrestressOutcome::Done;
  return result;
}

template <class Real>
void write(Body<Real>& body, const AssetRest& rest) {
  const Quat<double> turn(body.state.turn);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.state.displacement[i] = (turn * rest.displacements[i]).template cast<Real>();
    body.state.rotation[i] = (turn * rest.rotations[i] * turn.conjugate()).template cast<Real>();
  }
}

template <class Real>
bool isWhole(const Body<Real>& body) {
  return body.state.brokenCount == 0 && body.state.crushedCount == 0;
}

template <class Real>
StaticRestKey keyOf(const Body<Real>& body, const Eigen::Vector3d& gravity) {
  // Adding 0 makes -0 the same as 0.
  return {(body.state.turn.conjugate() * gravity).array() + 0.0, body.constants->material.youngsModulus,
          body.constants->material.density, body.constants->model.rotationalStiffness,
          std::is_same_v<Real, float> ? Precision::Float : Precision::Double};
}

// What must be so before any state is looked for; true if it is.
template <class Real>
bool canStand(const Body<Real>& body, const Eigen::Vector3d& gravity, PrestressResult& result) {
  if (body.state.anchorsIntact == 0 || !everyFragmentAnchored(body)) {
    result.outcome = PrestressOutcome::NotAnchored;
    result.reason = body.state.anchorsIntact == 0 ? "it has no anchors" : "a part of it hangs on no anchor";
    return false;
  }
  return gravity.squaredNorm() > 0;
}

// The state that the asset of a whole body keeps; `refusal` says why not.
PrestressResult kept(const Problem& p, const Asset& asset, std::uint64_t key) {
  PrestressResult result;
  if (asset.rest->key != key) {
    result.refusal = "it is of another material, model, gravity, precision or geometry";
    return result;
  }
  result.residual = worstOf(p, residualForce(p, *asset.rest));
  if (result.residual <= kPrestressTolerance) {
    result.outcome = PrestressOutcome::Kept;
  } else {
    result.refusal = text("it leaves %.3g of an element's weight unbalanced, allowed is %g", result.residual,
                          kPrestressTolerance);
  }
  return result;
}

template <class Real>
PrestressResult findStanding(const Body<Real>& body, const StaticRestKey& key, RestMethod method,
                             AssetRest& rest) {
  Problem p = problemOf(body, key.gravity);
  rest.key = hashOf(key, *body.constants->asset);
  PrestressResult known;
  if (body.constants->asset->rest && isWhole(body)) {
    known = kept(p, *body.constants->asset, rest.key);
    if (known.applied()) {
      rest = *body.constants->asset->rest;
      return known;
    }
  }
  PrestressResult result = solve(std::move(p), method, rest);
  result.refusal = known.refusal;
  return result;
}

}  // namespace

template <class Real>
PrestressResult findRest(const Body<Real>& body, const Eigen::Vector3d& gravity, RestMethod method,
                         AssetRest& rest) {
  PrestressResult result;
  if (!canStand(body, gravity, result)) return result;
  return findStanding(body, keyOf(body, gravity), method, rest);
}

template <class Real>
PrestressResult prestress(Body<Real>& body, const Eigen::Vector3d& gravity, StaticRestCache* cache,
                          RestMethod method) {
  PrestressResult result;
  if (!canStand(body, gravity, result)) return result;
  StaticRestCache::Entry entry;
  entry.key = keyOf(body, gravity);
  if (!isWhole(body)) cache = nullptr;
  if (const auto* known = cache ? cache->find(body.constants->asset, entry.key) : nullptr) {
    result = known->result;
    if (result.outcome != PrestressOutcome::Done) return result;
    write(body, known->rest);
    result.outcome = PrestressOutcome::Cached;
    return result;
  }
  result = findStanding(body, entry.key, method, entry.rest);
  if (result.applied()) write(body, entry.rest);
  if (!cache || result.outcome == PrestressOutcome::Kept) return result;
  if (!result.applied()) entry.rest = {};
  entry.asset = body.constants->asset;
  entry.result = result;
  entry.result.refusal.clear();  // said once
  cache->add(std::move(entry));
  return result;
}

template PrestressResult findRest(const Body<float>&, const Eigen::Vector3d&, RestMethod, AssetRest&);
template PrestressResult findRest(const Body<double>&, const Eigen::Vector3d&, RestMethod, AssetRest&);
template PrestressResult prestress(Body<float>&, const Eigen::Vector3d&, StaticRestCache*, RestMethod);
template PrestressResult prestress(Body<double>&, const Eigen::Vector3d&, StaticRestCache*, RestMethod);

}  // namespace rubble::edem
