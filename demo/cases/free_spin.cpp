// A box that tumbles freely, with three different moments of inertia and a spin about none of their axes.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace free_spin {
namespace {

const Eigen::Vector3d kSize(0.3, 0.2, 0.1);  // [m]
const Eigen::Vector3d kSpin(2, 9, 4);        // [rad/s]
constexpr double kDensity = 2400;            // [kg/m^3]
constexpr double kModulus = 3e9;             // [Pa]; it stretches by 1e-6 of its length
constexpr double kSimulated = 1;             // [s]
constexpr std::size_t kElements = 64;

double angleOf(const Eigen::Matrix3d& rotation) {
  return Eigen::AngleAxisd(rotation).angle();
}

// What a set of elements at rest is as a rigid body.
struct MassPoints {
  explicit MassPoints(const Asset& asset) : masses(asset.volumes.size()) {
    double mass = 0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      masses[i] = kDensity * asset.volumes[i];
      mass += masses[i];
      centre += masses[i] * asset.positions[i];
    }
    centre /= mass;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const Eigen::Vector3d r = asset.positions[i] - centre;
      inertia += masses[i] *
                 ((r.squaredNorm() + asset.gyrations[i]) * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
  }
  std::vector<double> masses;                         // [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about it [kg m^2]
};

// The rotation that takes the places at rest nearest to those now (Kabsch, least squares by mass).
Eigen::Matrix3d fittedRotation(const MassPoints& body, const std::vector<Eigen::Vector3d>& rest,
                               const std::vector<Eigen::Vector3d>& now) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    centre += body.masses[i] * now[i];
    mass += body.masses[i];
  }
  centre /= mass;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < now.size(); ++i)
    covariance += body.masses[i] * (now[i] - centre) * (rest[i] - body.centre).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

CaseOutcome runElements(Precision precision, double substepSafety, bool momentum) {
  constexpr double kTick = 1.0 / 240;  // [s]
  CaseWorld world(0);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox(kSize, kElements);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.spin = toBullet(kSpin);
  Destruction& destruction = world.destruct(precision, substepSafety);
  const DestructibleBody* box = destruction.addBody(def);
  const MassPoints points(*def.asset);
  for (int tick = 0; tick < int(std::lround(kSimulated / kTick)); ++tick) world.step(kTick);
  if (momentum) {
    const Eigen::Vector3d expected = points.inertia * kSpin;
    return world.outcome((destruction.ledger().angularMomentum - expected).norm() / expected.norm());
  }
  const Eigen::Matrix3d rotation = fittedRotation(points, def.asset->positions, placesOf(*box));
  return world.outcome(angleOf(rotation.transpose() * tumbled(points.inertia, kSpin, kSimulated)));
}

CaseOutcome runStock(double rate, bool momentum) {
  CaseWorld world(0);
  const double mass = kDensity * kSize.prod();
  btRigidBody& box = world.add(mass, std::make_unique<btBoxShape>(toBullet(kSize / 2)), {0, 0, 0});
  box.setAngularVelocity(toBullet(kSpin));
  const Eigen::Vector3d squares = kSize.cwiseAbs2();
  const Eigen::Matrix3d inertia =
      (mass / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares)).asDiagonal();
  for (int tick = 0; tick < int(std::lround(kSimulated * rate)); ++tick) world.step(1 / rate);
  Eigen::Matrix3d rotation;
  for (int column = 0; column < 3; ++column)
    rotation.col(column) = bullet::toEigen(box.getWorldTransform().getBasis().getColumn(column));
  if (momentum) {
    const Eigen::Vector3d expected = inertia * kSpin;
    const Eigen::Vector3d found =
        rotation * inertia * rotation.transpose() * bullet::toEigen(box.getAngularVelocity());
    return world.outcome((found - expected).norm() / expected.norm());
  }
  return world.outcome(angleOf(rotation.transpose() * tumbled(inertia, kSpin, kSimulated)));
}

}  // namespace
}  // namespace free_spin

Eigen::Matrix3d tumbled(const Eigen::Matrix3d& inertia, const Eigen::Vector3d& spin, double seconds) {
  constexpr int kSteps = 20000;  // classical Runge-Kutta: the error is that of rounding
  const double h = seconds / kSteps;
  const Eigen::Vector3d momentum = inertia * spin;
  const Eigen::Matrix3d inverse = inertia.inverse();
  using Quaternion = Eigen::Quaterniond;
  // dq/dt = w q / 2, w = R I^-1 R^T L of the constant L.
  const auto slope = [&](const Quaternion& q) {
    const Eigen::Matrix3d r = q.normalized().toRotationMatrix();
    const Eigen::Vector3d w = r * inverse * r.transpose() * momentum;
    return (0.5 * (Quaternion(0, w.x(), w.y(), w.z()) * q).coeffs()).eval();
  };
  Eigen::Vector4d q = Quaternion::Identity().coeffs();
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector4d a = slope(Quaternion(q)), b = slope(Quaternion(Eigen::Vector4d(q + h / 2 * a))),
                          c = slope(Quaternion(Eigen::Vector4d(q + h / 2 * b))),
                          d = slope(Quaternion(Eigen::Vector4d(q + h * c)));
    q = (q + h / 6 * (a + 2 * b + 2 * c + d)).normalized();
  }
  return Quaternion(q).toRotationMatrix();
}

ReportCase freeSpinCase() {
  using namespace free_spin;
  ReportCase c{
      .name = "free_spin",
      .what =
          "A free box of 0.3 x 0.2 x 0.1 m, 64 elements, 2400 kg/m3, E 3 GPa, tumbles at 10 rad/s for 1 s",
      .closedForm =
          "Euler's equations of the rigid body of the same masses; what is left in double is the stretch of "
          "the box that spins, and grows as 1 / E",
      .error = "attitude: angle [rad] after 1 s; angular momentum: relative error",
      .runs = {}};
  for (const bool momentum : {false, true}) {
    const std::string quantity = momentum ? "angular momentum" : "attitude";
    for (const CaseRun& run : substepRuns(quantity, [=](Precision precision, double safety) {
           return runElements(precision, safety, momentum);
         }))
      c.runs.push_back(run);
    for (const double rate : {60.0, 240.0, 1000.0}) {
      c.runs.push_back({quantity + ", Bullet's rigid box", rounded(rate) + " Hz", false, true,
                        [=] { return runStock(rate, momentum); }});
    }
  }
  return c;
}

}  // namespace rubble::demo
