// The pore spring alone: eq. (3) as an energy, and what follows from it.
#include "edem/spring.h"

#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::Quat;
using edem::Spring;
using edem::SpringEnd;
using edem::SpringLoad;
using edem::Vec3;

Spring<double> someSpring() {
  Spring<double> s{};
  s.second = 1;
  s.rest = Vec3<double>(0.2, -0.1, 0.15);
  s.offset = Vec3<double>(0.03, 0.05, -0.02);
  s.stiffness = 7e5;
  s.rotational = 900;
  s.damping = 300;
  s.rotationalDamping = 2;
  s.area = 0.04;
  return s;
}

Quat<double> turn(const Vec3<double>& v) {
  return Quat<double>(v.norm() > 0 ? Eigen::AngleAxisd(v.norm(), v.normalized())
                                   : Eigen::AngleAxisd::Identity());
}

// Two ends in general position: strains of some percent, rotations of some tenths of a radian.
std::pair<SpringEnd<double>, SpringEnd<double>> someEnds(Numbers& numbers) {
  std::pair<SpringEnd<double>, SpringEnd<double>> ends;
  for (SpringEnd<double>* e : {&ends.first, &ends.second}) {
    e->displacement = numbers.vector(0.02);
    e->turn = turn(numbers.vector(0.3));
    e->velocity = numbers.vector(3);
    e->spin = numbers.vector(5);
  }
  return ends;
}

double energy(const Spring<double>& s, const SpringEnd<double>& a, const SpringEnd<double>& b) {
  const SpringLoad<double> load = springLoad(s, a, b);
  return load.stretchEnergy + load.rotationEnergy;
}

TEST(Spring, ForceAndTorqueAreTheGradientOfItsEnergy) {
  const Spring<double> spring = someSpring();
  Numbers numbers;
  constexpr double kStep =
      1e-6;  // central differences: error of order 1e-12 of the third derivative, and rounding
  for (int n = 0; n < 20; ++n) {
    const auto [a, b] = someEnds(numbers);
    const SpringLoad<double> load = springLoad(spring, a, b);
    const Vec3<double> torqueFirst = load.armFirst.cross(load.elastic) + load.elasticTorque;
    const Vec3<double> torqueSecond = load.armSecond.cross(load.elastic) - load.elasticTorque;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<double> e = kStep * Vec3<double>::Unit(axis);
      const auto slope = [&](bool second, bool rotate) {
        const auto at = [&](double sign) {
          SpringEnd<double> p = a, q = b;
          SpringEnd<double>& moved = second ? q : p;
          if (rotate) {
            moved.turn = turn(sign * e) * moved.turn;
          } else {
            moved.displacement += sign * e;
          }
          return energy(spring, p, q);
        };
        return (at(1) - at(-1)) / (2 * kStep);
      };
      const double force = load.elastic.norm(), torque = torqueFirst.norm() + torqueSecond.norm();
      EXPECT_NEAR(-slope(false, false), load.elastic[axis], 1e-6 * force);
      EXPECT_NEAR(-slope(true, false), -load.elastic[axis], 1e-6 * force);
      EXPECT_NEAR(-slope(false, true), torqueFirst[axis], 1e-6 * torque);
      EXPECT_NEAR(-slope(true, true), torqueSecond[axis], 1e-6 * torque);
    }
  }
}

TEST(Spring, ForcesAndMomentsOfSpringAndDashpotSumToNothing) {
  const Spring<double> spring = someSpring();
  Numbers numbers;
  for (int n = 0; n < 20; ++n) {
    const auto [a, b] = someEnds(numbers);
    const SpringLoad<double> load = springLoad(spring, a, b);
    const Vec3<double> f = load.elastic + load.damping;
    const Vec3<double> between = spring.rest + b.displacement - a.displacement;
    // About element I: both torques, and K's force (-f) at x_K - x_I. The torques of the rotational part
    // cancel as written.
    const Vec3<double> sum = load.armFirst.cross(f) + load.armSecond.cross(f) + between.cross(-f);
    EXPECT_LT(sum.norm(), 1e-14 * between.norm() * f.norm() * 10);
  }
}

TEST(Spring, PowerIsTheRateAtWhichItsEnergyFalls) {
  const Spring<double> spring = someSpring();
  Numbers numbers;
  constexpr double kTime = 1e-7;
  for (int n = 0; n < 20; ++n) {
    const auto [a, b] = someEnds(numbers);
    const auto after = [](const SpringEnd<double>& e, double t) {
      SpringEnd<double> m = e;
      m.displacement += t * e.velocity;
      m.turn = turn(t * e.spin) * e.turn;
      return m;
    };
    const double rate = (energy(spring, after(a, kTime), after(b, kTime)) -
                         energy(spring, after(a, -kTime), after(b, -kTime))) /
                        (2 * kTime);
    const SpringLoad<double> load = springLoad(spring, a, b);
    EXPECT_NEAR(load.power, -rate, 1e-5 * (load.elastic.norm() * 6 + load.elasticTorque.norm() * 10));
  }
}

TEST(Spring, DashpotsNeverGiveEnergy) {
  const Spring<double> spring = someSpring();
  Numbers numbers;
  for (int n = 0; n < 100; ++n) {
    const auto [a, b] = someEnds(numbers);
    const SpringLoad<double> load = springLoad(spring, a, b);
    const double power = load.damping.dot(a.velocity - b.velocity) +
                         (load.armFirst.cross(load.damping) + load.dampingTorque).dot(a.spin) +
                         (load.armSecond.cross(load.damping) - load.dampingTorque).dot(b.spin);
    EXPECT_LE(power, 1e-9);
  }
}

template <class Real>
class SpringOf : public ::testing::Test {};
TYPED_TEST_SUITE(SpringOf, Scalars);

TYPED_TEST(SpringOf, RigidMotionLoadsNothing) {
  using Real = TypeParam;
  const Spring<double> wide = someSpring();
  Spring<Real> spring{};
  spring.rest = wide.rest.cast<Real>();
  spring.stiffness = Real(wide.stiffness);
  spring.rotational = Real(wide.rotational);
  spring.damping = Real(wide.damping);
  spring.rotationalDamping = Real(wide.rotationalDamping);
  Numbers numbers;
  for (int n = 0; n < 20; ++n) {
    const Quat<double> q = turn(numbers.vector(0.2));
    const Vec3<double> shift = numbers.vector(0.01), v = numbers.vector(3), w = numbers.vector(5);
    SpringEnd<Real> a, b;
    a.displacement = shift.cast<Real>();
    b.displacement = (shift + (q.toRotationMatrix() - Eigen::Matrix3d::Identity()) * wide.rest).cast<Real>();
    a.turn = b.turn = Quat<Real>(q.cast<Real>());
    a.spin = b.spin = w.cast<Real>();
    a.velocity = v.cast<Real>();
    b.velocity = (v + w.cross(q.toRotationMatrix() * wide.rest)).cast<Real>();
    const SpringLoad<Real> load = springLoad(spring, a, b);
    // Rounding of displacements (about 0.05 m) and of velocities (about 5 m/s), some units in the last place.
    const double epsilon = 8 * double(std::numeric_limits<Real>::epsilon());
    EXPECT_LT(double(load.elastic.norm()), wide.stiffness * 0.1 * epsilon);
    EXPECT_LT(double(load.damping.norm()), wide.damping * 5 * epsilon);
    EXPECT_LT(double(load.elasticTorque.norm()), wide.rotational * epsilon);
    EXPECT_EQ(load.dampingTorque.norm(), Real(0));
  }
}

}  // namespace
}  // namespace rubble::test
