// Destructible bodies on triangle meshes and height fields of Bullet.
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "bullet/bullet_world.h"
#include "bullet/regime_bodies.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr int kSquares = 16;  // of 0.5 m, each of two triangles
constexpr double kSquare = 0.5, kHalf = 0.5 * kSquares * kSquare;

// The ground at y = slope x + bumps, as triangles.
struct Ground {
  explicit Ground(double slope = 0, bool turned = false, double bumps = 0) {
    const auto corner = [&](int x, int z) {
      const double a = kSquare * x - kHalf, b = kSquare * z - kHalf;
      return btVector3(btScalar(a), btScalar(slope * a + bumps * std::sin(3 * a) * std::cos(2 * b)),
                       btScalar(b));
    };
    for (int x = 0; x < kSquares; ++x)
      for (int z = 0; z < kSquares; ++z) {
        const btVector3 a = corner(x, z), b = corner(x, z + 1), c = corner(x + 1, z + 1),
                        d = corner(x + 1, z);
        mesh.addTriangle(a, turned ? c : b, turned ? b : c);
        mesh.addTriangle(a, turned ? d : c, turned ? c : d);
      }
    heights.fill(0);
  }
  btTriangleMesh mesh;
  std::array<btScalar, (kSquares + 1) * (kSquares + 1)> heights;  // which Bullet calls PHY_FLOAT
};

// 2 x 2 x 2 cubes of 0.1 m, of explicit elements.
DestructibleBody* addBlock(BulletWorld& w, double height, double x = 0.13) {
  DestructibleBodyDef def;
  GridAssetDef grid;
  grid.cubes = {2, 2, 2};
  grid.edge = 0.1;
  def.asset = std::make_shared<const Asset>(gridAsset(grid));
  def.material = material("concrete_soft");
  def.material.friction = 1;
  def.transform.setOrigin({btScalar(x), btScalar(height), btScalar(0.07)});
  def.regime = Regime::Elements;
  return w.destruction->addBody(def);
}

// Of the centres.
double lowest(const DestructibleBody& body) {
  double y = 1e9;
  for (const ElementPose& e : posesOf(body)) y = std::min(y, double(e.position.y()));
  return y;
}

struct Rest {
  double height, creep;
  bool asleep;
  std::uint32_t broken;
};

// Of a block that falls 5 cm onto a ground; null: the plane.
Rest restOn(btCollisionShape* shape, double y = 0, double x = 0.13) {
  BulletWorld w;
  if (shape) {
    w.world.removeRigidBody(w.ground);
    btRigidBody* ground = w.add(0, *shape, {0, btScalar(y), 0});
    ground->setFriction(1);
  }
  w.ground->setFriction(1);
  DestructibleBody* block = addBlock(w, 0.05, x);
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  const double before = double(posesOf(*block)[0].position.x());
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  const Rest rest{lowest(*block), double(posesOf(*block)[0].position.x()) - before, !block->isActive(),
                  w.destruction->counts().springsBroken};
  if (shape) w.world.addRigidBody(w.ground);
  return rest;
}

// On the ground of two triangles a square as on Bullet's plane: at the same height to a hundredth of a
// millimetre, whatever edges run under it, still, asleep and whole.
void expectRestsAsOnThePlane(btCollisionShape& shape, const char* name, double y = 0) {
  static const Rest plane = restOn(nullptr);
  const Rest rest = restOn(&shape, y);
  EXPECT_NEAR(plane.height, 0.05, 1e-4);
  EXPECT_NEAR(rest.height, plane.height, 1e-5) << name;
  EXPECT_NEAR(rest.creep, 0, 1e-6) << name;
  EXPECT_TRUE(rest.asleep) << name;
  EXPECT_EQ(rest.broken, 0u) << name;
}

TEST(MeshGround, BlocksRestOnEachKind) {
  Ground ground;
  btBvhTriangleMeshShape bvh(&ground.mesh, true);
  expectRestsAsOnThePlane(bvh, "triangles");
  btScaledBvhTriangleMeshShape scaled(&bvh, {2, 1, btScalar(0.7)});
  expectRestsAsOnThePlane(scaled, "scaled triangles");
  btHeightfieldTerrainShape heights(kSquares + 1, kSquares + 1, ground.heights.data(), 1, -1, 1, 1, PHY_FLOAT,
                                    false);
  heights.setLocalScaling({btScalar(kSquare), 1, btScalar(kSquare)});
  expectRestsAsOnThePlane(heights, "height field");
  btGImpactMeshShape gimpact(&ground.mesh);
  gimpact.setMargin(0);
  gimpact.updateBound();
  expectRestsAsOnThePlane(gimpact, "gimpact");
  btCompoundShape compound;
  compound.addChildShape(btTransform(btQuaternion({0, 1, 0}, btScalar(0.4)), {0, btScalar(-0.3), 0}), &bvh);
  expectRestsAsOnThePlane(compound, "in a compound", 0.3);
}

TEST(MeshGround, EitherWayRound) {
  Ground turned(0, true);
  btBvhTriangleMeshShape shape(&turned.mesh, true);
  expectRestsAsOnThePlane(shape, "triangles that look down");
}

// Bullet's own bodies keep that distance.
TEST(MeshGround, AMarginIsKept) {
  Ground ground;
  btBvhTriangleMeshShape shape(&ground.mesh, true);
  shape.setMargin(btScalar(0.02));
  expectRestsAsOnThePlane(shape, "with a margin", -0.02);
}

// A box of twelve triangles bears like Bullet's box, in its middle and at its edge.
TEST(MeshGround, ABoxOfTrianglesIsABox) {
  const btVector3 half(btScalar(0.5), btScalar(0.25), btScalar(0.5));
  btTriangleMesh mesh;
  const auto corner = [&](int axis, int side, int a, int b) {
    btVector3 v;
    v[axis] = btScalar(side) * half[axis];
    v[(axis + 1) % 3] = btScalar(a) * half[(axis + 1) % 3];
    v[(axis + 2) % 3] = btScalar(b) * half[(axis + 2) % 3];
    return v;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const btVector3 a = corner(axis, side, -side, -1), b = corner(axis, side, side, -1),
                      c = corner(axis, side, side, 1), d = corner(axis, side, -side, 1);
      mesh.addTriangle(a, b, c);
      mesh.addTriangle(a, c, d);
    }
  btBvhTriangleMeshShape triangles(&mesh, true);
  btBoxShape box(half);
  for (const double x : {0.0, 0.25}) {
    const Rest onMesh = restOn(&triangles, -0.25, x), onBox = restOn(&box, -0.25, x);
    EXPECT_NEAR(onMesh.height, onBox.height, 1e-4) << x;
    EXPECT_NEAR(onMesh.height, 0.05, 1e-3) << x;
    EXPECT_TRUE(onMesh.asleep) << x;
  }
}

// 0.2 is less than friction holds (0.5, after Bullet's default for the ground); gravity along it is 1.9
// m/s^2.
TEST(MeshGround, NothingCreepsDownASlope) {
  Ground ground(0.2);
  btBvhTriangleMeshShape shape(&ground.mesh, true);
  BulletWorld w;
  w.world.removeRigidBody(w.ground);
  w.add(0, shape, {0, 0, 0});
  DestructibleBody* block = addBlock(w, 0.08);
  for (int tick = 0; tick < 360; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  const double x = double(posesOf(*block)[0].position.x());
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  EXPECT_NEAR(double(posesOf(*block)[0].position.x()), x, 1e-4);
  EXPECT_TRUE(!block->isActive());
  w.world.addRigidBody(w.ground);
}

// Application changes the heights: what lay on a hill falls.
TEST(MeshGround, FollowsHeightsThatChange) {
  Ground ground;
  ground.heights.fill(btScalar(0.5));
  btHeightfieldTerrainShape heights(kSquares + 1, kSquares + 1, ground.heights.data(), 1, -1, 1, 1, PHY_FLOAT,
                                    false);
  heights.setLocalScaling({btScalar(kSquare), 1, btScalar(kSquare)});
  BulletWorld w;
  w.world.removeRigidBody(w.ground);
  w.add(0, heights, {0, 0, 0});
  DestructibleBody* block = addBlock(w, 0.5);
  const auto step = [&](int ticks) {
    for (int tick = 0; tick < ticks; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  };
  step(60);
  EXPECT_NEAR(lowest(*block), 0.55, 1e-3);
  ground.heights.fill(btScalar(0.2));
  step(120);
  EXPECT_NEAR(lowest(*block), 0.25, 1e-3);
  w.world.addRigidBody(w.ground);
}

// A wall on a hilly ground is shot to rubble and debris: none of it goes through.
TEST(MeshGround, RubbleAndDebrisStayAbove) {
  constexpr double kBumps = 0.1;
  Ground ground(0, false, kBumps);
  btBvhTriangleMeshShape shape(&ground.mesh, true);
  DestructionDef def;
  def.debris = true;
  BulletWorld w(def);
  w.world.removeRigidBody(w.ground);
  delete w.ground;
  w.add(0, shape, {0, 0, 0});
  Material weak = material("concrete_soft");
  DestructibleBodyDef wall;
  wall.regime = Regime::Elements;
  wall.asset = smallWall();
  wall.material = weak;
  wall.transform.setOrigin({0, btScalar(kBumps), 0});
  DestructibleBody* body = w.destruction->addBody(wall);
  btRigidBody* ball = w.add(20, w.ballShape, {btScalar(0.05), btScalar(0.4), -1});
  ball->setLinearVelocity({0, -4, 20});
  for (int tick = 0; tick < 120; ++tick) w.world.stepSimulation(btScalar(1) / 120, 1, btScalar(1) / 120);
  EXPECT_GT(w.destruction->counts().springsBroken, 100u);
  const auto above = [&](const Eigen::Vector3d& p) {
    return p.y() - kBumps * std::sin(3 * p.x()) * std::cos(2 * p.z());
  };
  const double radius = body->asset()->radius;
  const std::vector<ElementPose> poses = posesOf(*body);
  std::size_t alive = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!body->elementsAlive()[i]) continue;
    const Eigen::Vector3d at = poses[i].position.cast<double>();
    if (std::max(std::abs(at.x()), std::abs(at.z())) > kHalf) continue;  // over the edge of the ground
    ++alive;
    // Half a radius in: squares of half a metre are flat, the sine is not (0.04 m at most).
    EXPECT_GT(above(at), 0.5 * radius - 0.04) << i << ": " << at.transpose();
  }
  EXPECT_GT(alive, 100u);
  for (const DebrisPiece& d : w.destruction->debris()) {
    const Eigen::Vector3d at = d.position.cast<double>();
    if (std::max(std::abs(at.x()), std::abs(at.z())) > kHalf) continue;
    EXPECT_GT(above(at), -0.04) << at.transpose();
  }
}

}  // namespace
}  // namespace rubble::test
