// The substep bound against the true highest frequency.
#include "edem/stable_step.h"

#include <Eigen/Dense>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

edem::RateBound boundOf(const edem::Body<double>& body) {
  std::vector<edem::ElementRates> rates(body.elementCount());
  edem::springRates(body, std::span(rates));
  return edem::springBound(body, std::span<const edem::ElementRates>(rates));
}

// omega^2 of the stiffest mode, by power iteration on M^-1 K; K is the derivative of the forces themselves.
double highestFrequency2(edem::Body<double> body) {
  constexpr double kSmall = 1e-8;
  const Eigen::Index n = Eigen::Index(body.elementCount());
  Numbers numbers;
  Eigen::VectorXd x(6 * n);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = numbers.next();
  x.normalize();
  double eigenvalue = 0;
  edem::Books books;
  for (int round = 0; round < 400; ++round) {
    edem::beginSubstep(body.state, body.work);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t e = std::size_t(i);
      // Scaled by the roots of mass and inertia, so that the operator is symmetric.
      body.state.displacement[e] = kSmall / std::sqrt(body.constants->mass[e]) * x.segment<3>(6 * i);
      const Eigen::Vector3d half =
          0.5 * kSmall / std::sqrt(body.constants->inertia[e]) * x.segment<3>(6 * i + 3);
      body.state.rotation[e] = edem::Quat<double>(1, half.x(), half.y(), half.z()).normalized();
    }
    edem::accumulateSprings(body, body.work, 0, false, books);
    Eigen::VectorXd y(6 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t e = std::size_t(i);
      y.segment<3>(6 * i) = -body.work.force[e] / (kSmall * std::sqrt(body.constants->mass[e]));
      y.segment<3>(6 * i + 3) = -body.work.torque[e] / (kSmall * std::sqrt(body.constants->inertia[e]));
    }
    eigenvalue = x.dot(y);
    x = y.normalized();
  }
  return eigenvalue;
}

TEST(StableStep, BoundsTheTrueHighestFrequency) {
  for (const std::array<int, 3>& cubes :
       {std::array{2, 1, 1}, std::array{5, 1, 1}, std::array{3, 3, 3}, std::array{6, 5, 1}}) {
    for (const bool anchored : {false, true}) {
      const auto body = edem::makeBody<double>(block(cubes, anchored), 0);
      const double bound = boundOf(body).frequency2, truth = highestFrequency2(body);
      EXPECT_LE(truth, bound * (1 + 1e-6)) << cubes[0] << "x" << cubes[1] << "x" << cubes[2];
      EXPECT_GT(truth, 0.25 * bound) << "a bound so loose costs half the speed";
    }
  }
}

// Largest total energy over the first, in `substeps` of `step` without damping or breaking.
double energyGrowth(double step, int substeps) {
  OneBody<double> one(block({3, 3, 3}));
  Numbers numbers;
  for (auto& v : one.body().state.velocity) v = numbers.vector(1e-3);
  for (auto& w : one.body().state.spin) w = numbers.vector(1e-2);
  double first = 0, most = 0;
  for (int n = 0; n < substeps; ++n) {
    one.substep(step, false);
    const double energy = one.books().kinetic + one.books().elastic;
    if (n == 0) first = energy;
    most = std::max(most, std::abs(energy));
  }
  return most / first;
}

TEST(StableStep, EnergyStaysBoundedAtTheBound) {
  const auto body = edem::makeBody<double>(block({3, 3, 3}), 0);
  const double step = boundOf(body).stableStep();
  // Leapfrog keeps v(n-1/2).v(n+1/2) m/2 + U exactly for linear springs; these strains are linear to 1e-5.
  EXPECT_LT(energyGrowth(step, 2000), 1.01);
}

TEST(StableStep, EnergyExplodesAboveTheTrueLimit) {
  const auto body = edem::makeBody<double>(block({3, 3, 3}), 0);
  EXPECT_GT(energyGrowth(1.05 * 2 / std::sqrt(highestFrequency2(body)), 200), 100);
}

TEST(StableStep, DampingShortensItByTheClosedForm) {
  // v' = v - h (gamma v + omega^2 x), x' = x + h v' has a root at -1 where h^2 omega^2 + 2 h gamma = 4.
  edem::RateBound bound;
  bound.add({9e6, 500}, {7e6, 300});
  const double h = bound.stableStep();
  EXPECT_NEAR(h * h * 16e6 + 2 * h * 800, 4, 1e-9);
}

TEST(StableStep, SolverUsesASmallerStepThanTheBound) {
  const auto solver = makeSolver<double>();
  const edem::BodyDef def = block({3, 3, 3});
  solver->addBody(def, kNoGravity);
  solver->tick(kFrame, kNoGravity, {});
  EXPECT_LE(solver->report().substep, boundOf(edem::makeBody<double>(def, 0)).stableStep());
}

}  // namespace
}  // namespace rubble::test
