#include "edem/prestress.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <vector>

namespace rubble::edem {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

Eigen::Matrix3d cross(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

template <class Real>
bool everyFragmentAnchored(const Body<Real>& body) {
  std::vector<std::uint8_t> held(body.elementCount(), 0);
  for (std::size_t a = body.anchorBegin; a < body.springs.size(); ++a)
    if (body.intact[a]) held[body.fragment[body.springs[a].first]] = 1;
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    if (body.alive[i] && !held[body.fragment[i]]) return false;
  return true;
}

// Stiffness of the springs at rest: dx = u_K - u_I - (theta_I + theta_K) x d / 2, relative rotation theta_K
// - theta_I.
template <class Real>
Matrix assemble(const Body<Real>& body) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(body.springs.size() * 144);
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    if (!body.intact[s]) continue;
    const Spring<Real>& spring = body.springs[s];
    const Eigen::Matrix3d halfArm =
        0.5 * cross(spring.rest.template cast<double>());  // -(theta x d)/2 = halfArm theta
    Eigen::Matrix<double, 6, 12> b = Eigen::Matrix<double, 6, 12>::Zero();
    b.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
    b.block<3, 3>(0, 3) = halfArm;
    b.block<3, 3>(0, 6) = Eigen::Matrix3d::Identity();
    b.block<3, 3>(0, 9) = halfArm;
    b.block<3, 3>(3, 3) = -Eigen::Matrix3d::Identity();
    b.block<3, 3>(3, 9) = Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 6, 1> k;
    k << Eigen::Vector3d::Constant(double(spring.stiffness)),
        Eigen::Vector3d::Constant(double(spring.rotational));
    const Eigen::Matrix<double, 12, 12> block = b.transpose() * k.asDiagonal() * b;
    const int ends = body.isAnchor(s) ? 1 : 2;
    const std::array<Eigen::Index, 2> base = {6 * Eigen::Index(spring.first),
                                              6 * Eigen::Index(spring.second)};
    for (int p = 0; p < ends; ++p)
      for (int q = 0; q < ends; ++q)
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j)
            entries.emplace_back(base[std::size_t(p)] + i, base[std::size_t(q)] + j,
                                 block(6 * p + i, 6 * q + j));
  }
  const Eigen::Index unknowns = 6 * Eigen::Index(body.elementCount());
  // A lone chain without k_rot has modes without stiffness; a crushed element has none at all. A tiny
  // diagonal keeps the factor definite and moves the solution by the same tiny share.
  double largest = 0;
  for (const auto& e : entries) largest = std::max(largest, std::abs(e.value()));
  for (Eigen::Index i = 0; i < unknowns; ++i) entries.emplace_back(i, i, 1e-12 * largest);
  Matrix k(unknowns, unknowns);
  k.setFromTriplets(entries.begin(), entries.end());
  return k;
}

// Force and torque on every element in the present state, gravity included; all in double.
template <class Real>
Vector residualForce(const Body<Real>& body, const Eigen::Vector3d& gravity,
                     const std::vector<Vec3<double>>& u, const std::vector<Quat<double>>& rotation) {
  Vector force = Vector::Zero(6 * Eigen::Index(body.elementCount()));
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    if (body.alive[i]) force.segment<3>(6 * Eigen::Index(i)) = body.mass[i] * gravity;
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    if (!body.intact[s]) continue;
    const Spring<Real>& own = body.springs[s];
    Spring<double> spring{};
    spring.rest = own.rest.template cast<double>();
    spring.stiffness = double(own.stiffness);
    spring.rotational = double(own.rotational);
    const auto end = [&](std::uint32_t i) {
      SpringEnd<double> e;
      e.displacement = u[i];
      e.turn = rotation[i];
      return e;
    };
    const bool anchor = body.isAnchor(s);
    const SpringLoad<double> load =
        springLoad(spring, end(own.first), anchor ? SpringEnd<double>{} : end(own.second));
    force.segment<3>(6 * Eigen::Index(own.first)) += load.elastic;
    force.segment<3>(6 * Eigen::Index(own.first) + 3) +=
        load.armFirst.cross(load.elastic) + load.elasticTorque;
    if (anchor) continue;
    force.segment<3>(6 * Eigen::Index(own.second)) -= load.elastic;
    force.segment<3>(6 * Eigen::Index(own.second) + 3) +=
        load.armSecond.cross(load.elastic) - load.elasticTorque;
  }
  return force;
}

}  // namespace

template <class Real>
bool prestress(Body<Real>& body, const Eigen::Vector3d& gravity, double* residual) {
  if (body.anchorsIntact == 0 || !everyFragmentAnchored(body)) return false;
  const Eigen::SimplicialLDLT<Matrix> factor(assemble(body));
  if (factor.info() != Eigen::Success) return false;
  std::vector<Vec3<double>> u(body.elementCount(), Vec3<double>::Zero());
  std::vector<Quat<double>> rotation(body.elementCount(), Quat<double>::Identity());
  constexpr int kCorrections = 4;  // each gains several digits at the strains of a standing object
  for (int n = 0; n < kCorrections; ++n) {
    const Vector step = factor.solve(residualForce(body, gravity, u, rotation));
    if (!step.allFinite()) return false;
    for (std::size_t i = 0; i < body.elementCount(); ++i) {
      u[i] += step.segment<3>(6 * Eigen::Index(i));
      const Eigen::Vector3d theta = step.segment<3>(6 * Eigen::Index(i) + 3);
      const double angle = theta.norm();
      if (angle > 0)
        rotation[i] = (Quat<double>(Eigen::AngleAxisd(angle, theta / angle)) * rotation[i]).normalized();
    }
  }
  // What cannot carry its weight has no such state: the corrections run away, and the body starts unstressed.
  const double size = body.asset->diagonal();
  for (const Vec3<double>& shift : u)
    if (!(shift.norm() <= size)) return false;
  if (residual) {
    const Vector left = residualForce(body, gravity, u, rotation);
    *residual = 0;
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      *residual =
          std::max(*residual, left.segment<3>(6 * Eigen::Index(i)).norm() / (body.mass[i] * gravity.norm()));
  }
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.displacement[i] = u[i].cast<Real>();
    body.rotation[i] = rotation[i].cast<Real>();
  }
  return true;
}

template bool prestress(Body<float>&, const Eigen::Vector3d&, double*);
template bool prestress(Body<double>&, const Eigen::Vector3d&, double*);

}  // namespace rubble::edem
