// Numbers that nobody should pass in: they are refused, or stay finite.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "debris/debris_system.h"
#include "rubble/error.h"
#include "unit/debris/cells.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
using namespace debris;
namespace {

using Eigen::Vector3d;
using test::Surroundings;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

bool isFinite(const Motion& m) {
  return std::isfinite(m.mass) && m.linear.allFinite() && m.angular.allFinite() && std::isfinite(m.kinetic);
}

TEST(HostileSpawn, RefusesElementsThatAreNotFiniteOrHaveNoMass) {
  const std::vector<std::function<void(base::CrushedElement&, double)>> fields = {
      [](base::CrushedElement& e, double x) { e.centre.x() = x; },
      [](base::CrushedElement& e, double x) { e.velocity.y() = x; },
      [](base::CrushedElement& e, double x) { e.spin.z() = x; },
      [](base::CrushedElement& e, double x) { e.mass = x; },
      [](base::CrushedElement& e, double x) { e.inertia = x; },
      [](base::CrushedElement& e, double x) { e.volume = x; },
      [](base::CrushedElement& e, double x) { e.radius = x; },
      [](base::CrushedElement& e, double x) { e.maxRadius = x; },
      [](base::CrushedElement& e, double x) { e.orientation.w() = x; },
      [](base::CrushedElement& e, double x) { e.releasedEnergy = x; },
      [](base::CrushedElement& e, double x) { e.restCentre.x() = x; }};
  Spawner spawner(Material{}, Model{}, 1);
  DebrisBatch batch;
  for (const auto& set : fields) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      test::TestCell cell = test::cubeCell(0.04, 2400);
      set(cell.element, bad);
      EXPECT_THROW(spawner.spawn(cell.element, cell.faces, batch), Error);
    }
  }
  test::TestCell cell = test::cubeCell(0.04, 2400);
  cell.element.mass = 0;
  EXPECT_THROW(spawner.spawn(cell.element, cell.faces, batch), Error);
}

TEST(HostileSpawn, RefusesFacesThatAreNotFinite) {
  Spawner spawner(Material{}, Model{}, 1);
  DebrisBatch batch;
  test::TestCell cell = test::cubeCell(0.04, 2400);
  cell.faces[3].normal.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(spawner.spawn(cell.element, cell.faces, batch), Error);
}

TEST(HostileSpawn, DegenerateCellsStayFiniteAndKeepTheirMomenta) {
  // All faces at the centre, in a line, without normals; no inertia; a modulus of energy that is enormous.
  Spawner spawner(Material{}, Model{}, 1);
  DebrisBatch batch;
  for (int kind = 0; kind < 4; ++kind) {
    test::TestCell cell = test::cubeCell(0.04, 2400);
    cell.element.velocity = {1e6, -2, 3};
    cell.element.spin = {1e4, 5, -6};
    cell.element.releasedEnergy = 1e11;
    float place = 0.001f;
    for (CellFace& face : cell.faces) {
      if (kind == 0) face.centroid.setZero();
      if (kind == 1) face.centroid = Eigen::Vector3f(place *= 2, 0, 0);
      if (kind == 2) face.normal.setZero();
    }
    if (kind == 3) cell.element.inertia = 0;
    spawner.spawn(cell.element, cell.faces, batch);
    const base::CrushedElement& e = cell.element;
    ASSERT_TRUE(isFinite(batch.piecesMotion)) << kind;
    const Motion whole = motionOf(e.mass, e.inertia, e.centre, e.velocity, e.spin);
    const Vector3d angular = batch.piecesMotion.angular + batch.dustMotion.angular - whole.angular;
    EXPECT_LT(angular.norm(), 1e-9 * e.mass * 1e6 * 0.1) << kind;
    EXPECT_LE(batch.energyGiven, e.releasedEnergy * (1 + 1e-9)) << kind;
  }
}

// The largest and the densest solid that is loaded, of one element: 1.9e22 kg, m h^2 / 6 is 1.1e33 kg m^2.
TEST(HostileSpawn, TheLargestElementBecomesDebrisAndKeepsItsMotion) {
  Spawner spawner(Material{}, Model{}, 1);
  DebrisBatch batch;
  const double edge = 1e6 / std::sqrt(3.0);
  test::TestCell cell = test::cubeCell(edge, 1e5);
  base::CrushedElement& e = cell.element;
  e.velocity = {1e4, -2, 3};
  e.spin = {1e4, 5, -6};
  e.releasedEnergy = 1e30;
  spawner.spawn(e, cell.faces, batch);
  const Motion whole = motionOf(e.mass, e.inertia, e.centre, e.velocity, e.spin);
  Motion all = batch.piecesMotion;
  all += batch.dustMotion;
  EXPECT_NEAR(all.mass, e.mass, 1e-12 * e.mass);
  EXPECT_LT((all.linear - whole.linear).norm(), 1e-9 * whole.linear.norm());
  EXPECT_LT((all.angular - whole.angular).norm(), 1e-9 * whole.angular.norm());
  EXPECT_LE(all.kinetic, (whole.kinetic + e.releasedEnergy) * (1 + 1e-9));

  DebrisSystem system({.maxDebris = 64, .reach = 1e12});
  system.add(batch.pieces);
  const Motion begun = system.motion();
  system.takeExchange();
  Surroundings ground({test::TestPlane{}});
  for (int i = 0; i < 50; ++i) system.step(1.0 / 60, kDown, ground);
  const Motion now = system.motion();
  const Exchange x = system.takeExchange();
  ASSERT_TRUE(isFinite(now));
  const Vector3d linear = begun.linear + x.gravity.linear + x.air.linear + x.contact.linear;
  EXPECT_LT((now.linear - linear).norm(), 1e-9 * begun.linear.norm());
  EXPECT_NEAR(now.kinetic, begun.kinetic + x.gravity.energy + x.air.energy + x.contact.energy,
              1e-9 * begun.kinetic);
}

TEST(HostileSpawn, RefusesMaterialsOutOfRange) {
  const auto make = [](const std::function<void(Material&)>& change) {
    Material material;
    change(material);
    Spawner(material, Model{}, 1);
  };
  EXPECT_THROW(make([](Material& m) { m.density = 0; }), Error);
  EXPECT_THROW(make([](Material& m) { m.debrisSpeed = kNan; }), Error);
  EXPECT_THROW(make([](Material& m) { m.dustRadius = 0; }), Error);
  EXPECT_THROW(make([](Material& m) { m.sizeModulus = 2; }), Error);
  EXPECT_THROW(make([](Material& m) { m.friction = -1; }), Error);
}

TEST(HostileSystem, RefusesDefinitionsOutOfRange) {
  EXPECT_THROW(DebrisSystem({.maxDebris = 0}), Error);
  EXPECT_THROW(DebrisSystem({.maxDebris = 0xffffffffu}), Error);
  EXPECT_THROW(DebrisSystem({.maxDebris = 1, .air = {kNan, 1}}), Error);
  EXPECT_THROW(DebrisSystem({.maxDebris = 1, .restitution = 1.1}), Error);
  EXPECT_THROW(DebrisSystem({.maxDebris = 1, .reach = 0}), Error);
}

TEST(HostileSystem, RefusesPiecesThatAreNotFiniteOrHaveNoMass) {
  const std::vector<std::function<void(DebrisParcel&, double)>> fields = {
      [](DebrisParcel& p, double x) { p.position.x() = x; },
      [](DebrisParcel& p, double x) { p.velocity.y() = x; },
      [](DebrisParcel& p, double x) { p.spin.z() = x; },
      [](DebrisParcel& p, double x) { p.mass = x; },
      [](DebrisParcel& p, double x) { p.inertia = x; },
      [](DebrisParcel& p, double x) { p.radius = x; },
      [](DebrisParcel& p, double x) { p.density = x; },
      [](DebrisParcel& p, double x) { p.friction = x; },
      [](DebrisParcel& p, double x) { p.orientation.x() = x; }};
  DebrisSystem system({.maxDebris = 4});
  for (const auto& set : fields) {
    for (const double bad : {kNan, kInfinity}) {
      DebrisParcel parcel = test::stone(1.0);
      set(parcel, bad);
      EXPECT_THROW(system.add({&parcel, 1}), Error);
    }
  }
  DebrisParcel parcel = test::stone(1.0);
  parcel.mass = 0;
  EXPECT_THROW(system.add({&parcel, 1}), Error);
  EXPECT_TRUE(system.pieces().empty());
}

TEST(HostileSystem, StepOfNoTimeChangesNothing) {
  DebrisSystem system({.maxDebris = 4});
  const DebrisParcel parcel = test::stone({0, 0.001, 0}, {1, -1, 0});
  system.add({&parcel, 1});
  Surroundings ground({test::TestPlane{}});
  const std::uint64_t hash = system.hash();
  system.step(0, kDown, ground);
  EXPECT_EQ(system.hash(), hash);
}

TEST(HostileSystem, RefusesStepsAndGravityThatAreNotFinite) {
  DebrisSystem system({.maxDebris = 4});
  const DebrisParcel parcel = test::stone(1.0);
  system.add({&parcel, 1});
  Surroundings ground({test::TestPlane{}});
  for (const double bad : {kNan, kInfinity, -1.0}) EXPECT_THROW(system.step(bad, kDown, ground), Error);
  EXPECT_THROW(system.step(0.01, {0, kNan, 0}, ground), Error);
}

TEST(HostileSystem, LongStepsAndExtremePiecesStayFinite) {
  DebrisSystem system({.maxDebris = 64});
  for (const double radius : {1e-12, 1e-6, 1.0, 1e9}) {
    for (const double speed : {0.0, 1.0, 1e12}) {
      for (const double mass : {1e-30, 1.0, 1e12}) {
        DebrisParcel parcel = test::stone({0, 1, 0}, {speed, -speed, 0}, radius);
        parcel.collisionRadius = 0;
        parcel.mass = mass;
        parcel.spin = {speed, 0, 0};
        system.add({&parcel, 1});
      }
    }
  }
  Surroundings ground({test::TestPlane{}});
  for (int i = 0; i < 50; ++i) {
    system.step(i % 2 ? 10.0 : 1e-9, kDown, ground);
    ASSERT_TRUE(isFinite(system.motion()));
  }
  for (const DebrisPiece& piece : system.pieces()) {
    EXPECT_TRUE(piece.position.allFinite() && piece.velocity.allFinite() &&
                piece.orientation.coeffs().allFinite());
    EXPECT_GE(piece.position.y(), 0);
  }
}

class LyingCollider : public DebrisCollider {
 public:
  DebrisHit answer{};
  DebrisSurface body{};
  std::uint32_t surfaceCount() const override { return 1; }
  DebrisSurface surface(std::uint32_t) const override { return body; }
  bool sweep(const Vector3d&, const Vector3d&, double, DebrisHit& hit) override {
    hit = answer;
    return true;
  }
};

TEST(HostileSystem, RefusesImpossibleHits) {
  const DebrisHit good{.fraction = 0.5, .normal = Vector3d::UnitY()};
  const auto step = [&](const std::function<void(DebrisHit&)>& change) {
    DebrisSystem system({.maxDebris = 4});
    const DebrisParcel parcel = test::stone(0.1);
    system.add({&parcel, 1});
    LyingCollider collider;
    collider.answer = good;
    change(collider.answer);
    system.step(0.01, kDown, collider);
  };
  EXPECT_NO_THROW(step([](DebrisHit&) {}));
  EXPECT_THROW(step([](DebrisHit& h) { h.fraction = kNan; }), Error);
  EXPECT_THROW(step([](DebrisHit& h) { h.fraction = 1.5; }), Error);
  EXPECT_THROW(step([](DebrisHit& h) { h.normal.setZero(); }), Error);
  EXPECT_THROW(step([](DebrisHit& h) { h.point.x() = kInfinity; }), Error);
  EXPECT_THROW(step([](DebrisHit& h) { h.surface = 7; }), Error);
}

TEST(HostileSystem, RefusesImpossibleSurfaces) {
  const auto step = [&](const std::function<void(DebrisSurface&)>& change) {
    DebrisSystem system({.maxDebris = 4});
    const DebrisParcel parcel = test::stone(0.1);
    system.add({&parcel, 1});
    LyingCollider collider;
    collider.answer = {.fraction = 0.5, .normal = Vector3d::UnitY(), .surface = 0};
    change(collider.body);
    system.step(0.01, kDown, collider);
  };
  EXPECT_NO_THROW(step([](DebrisSurface&) {}));
  EXPECT_THROW(step([](DebrisSurface& s) { s.centre.x() = kInfinity; }), Error);
  EXPECT_THROW(step([](DebrisSurface& s) { s.velocity.x() = kNan; }), Error);
  EXPECT_THROW(step([](DebrisSurface& s) { s.spin.z() = kNan; }), Error);
  EXPECT_THROW(step([](DebrisSurface& s) { s.inverseMass.y() = -1; }), Error);
  EXPECT_THROW(step([](DebrisSurface& s) { s.inverseInertia(1, 1) = -1; }), Error);
  EXPECT_THROW(step([](DebrisSurface& s) { s.inverseInertia(0, 1) = kNan; }), Error);
}

}  // namespace
}  // namespace rubble::test
