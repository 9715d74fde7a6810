// Bullet's hello world, a ball falling on the ground, with something breakable in its way, which is a rigid
// body as any other until the ball strikes it. The lines marked "ours" are all that Rubble adds. Links
// rubble::rubble alone: no OpenGL, no CGAL.
//
//     rubble_drop_in ASSET
#include <btBulletDynamicsCommon.h>

#include <exception>
#include <iostream>

#include "rubble/destruction.h"  // ours

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: rubble_drop_in ASSET");

  // Bodies are declared before the world, so that it goes first at the end.
  btBoxShape groundShape(btVector3(50, 50, 50));
  btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &groundShape));
  ground.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -50, 0)));

  btSphereShape ballShape(btScalar(0.15));
  btVector3 inertia;
  ballShape.calculateLocalInertia(34, inertia);
  btRigidBody ball(btRigidBody::btRigidBodyConstructionInfo(34, nullptr, &ballShape, inertia));
  ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 3, 0)));
  ball.setLinearVelocity(btVector3(0, -10, 0));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, -10, 0));
  world.addRigidBody(&ground);
  world.addRigidBody(&ball);

  rubble::Destruction destruction(world);                                     // ours
  rubble::DestructibleBodyDef def;                                            // ours
  def.asset = std::make_shared<const rubble::Asset>(rubble::load(argv[1]));   // ours
  def.material = def.asset->material();                                       // ours: as it was cooked
  def.transform.setOrigin({0, btScalar(-def.asset->bounds().min().y()), 0});  // ours: it stands on the ground
  destruction.addBody(def);                                                   // ours

  for (int frame = 0; frame < 60; ++frame) {
    world.stepSimulation(btScalar(1) / 60, 10);
    for (const rubble::SpringBroken& event : destruction.takeEvents().springsBroken)   // ours
      std::cout << "spring " << event.spring << " broke, " << event.energy << " J\n";  // ours
    const btVector3 at = ball.getWorldTransform().getOrigin();
    std::cout << "frame " << frame << ": ball at " << at.x() << ", " << at.y() << ", " << at.z() << '\n';
  }
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
