// A packed cube between the plates of a press, as Bullet's boxes are.
#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

edem::RigidProxy plate(double y, double speed, double friction) {
  edem::RigidProxy proxy;
  proxy.kinematic = true;
  proxy.friction = friction;
  edem::Collider part;
  part.kind = edem::Collider::Kind::Box;
  part.size = {kCubeEdge, 0.05, kCubeEdge};
  proxy.parts = {part};
  proxy.position.y() = y;
  proxy.velocity.y() = speed;
  return proxy;
}

// Largest mean stress on the upper plate over the time that sound takes there and back, over f_c.
double crushedBetweenPlates(std::size_t elements, double friction) {
  constexpr double kStrainRate = 0.5;  // [1/s], a hundredth of what sound needs to cross
  edem::BodyDef def;
  def.asset = packedCube(elements, 1);
  def.anchored = false;
  def.material.friction = friction;
  const auto solver = edem::Solver::make(Precision::Double, {});
  solver->addBody(def, kNoGravity);
  const double speed = 0.5 * kStrainRate * kCubeEdge, top = 0.5 * kCubeEdge + 0.05;
  std::vector<edem::RigidProxy> plates = {plate(-top, speed, 1), plate(top, -speed, 1)};
  const double echo = 2 * kCubeEdge / std::sqrt(def.material.youngsModulus / def.material.density);
  double peak = 0;
  for (double strain = 0; strain < 0.25; strain += kStrainRate * echo) {
    solver->tick(echo, kNoGravity, plates);
    EXPECT_EQ(solver->failure(), "");
    const double stress = plates[1].impulse.y() / echo / (kCubeEdge * kCubeEdge);
    peak = std::max(peak, stress);
    if (solver->view(0).broken > 0 && stress < 0.5 * peak) break;
  }
  return peak / def.material.compressiveStrength;
}

TEST(PlateStrength, APackedCubeCarriesItsStrengthBetweenRigidPlates) {
  for (const std::size_t elements : {216u, 512u}) {
    for (const double friction : {0.0, 0.6}) {
      const double share = crushedBetweenPlates(elements, friction);
      EXPECT_GT(share, 0.6) << elements << ", friction " << friction;
      EXPECT_LT(share, 1.3) << elements << ", friction " << friction;
      RecordProperty("f_over_fc_" + std::to_string(elements) + (friction > 0 ? "_rough" : "_smooth"),
                     std::to_string(share));
    }
  }
}

}  // namespace
}  // namespace rubble::test
