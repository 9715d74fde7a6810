#include "demo/world.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/hash.h"
#include "bullet/convert.h"
#include "demo/keys.h"
#include "demo/overlaps.h"
#include "demo/refuse_at.h"
#include "demo/scene_advice.h"
#include "demo/substeps.h"
#include "demo/words.h"
#include "rubble/limits.h"

namespace rubble::demo {
namespace {

btVector3 toBullet(const Eigen::Vector3d& v) {
  return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())};
}

btTransform placed(const Placement& at) {
  btTransform transform(btQuaternion::getIdentity(), toBullet(at.position));
  const double degrees = at.rotationDegrees.norm();
  if (degrees > 0) {
    const double angle = degrees * std::numbers::pi / 180;
    transform.setRotation(btQuaternion(toBullet(at.rotationDegrees / degrees), btScalar(angle)));
  }
  return transform;
}

// Where the asset's frame starts, seen from what stands at the object's position, in the object's axes [m].
Eigen::Vector3d startOf(const SceneObject& object, const Asset& asset) {
  return asset.origin - object.meshOrigin;
}

// Of the asset's frame. Throws where Bullet's floats would not hold it.
btTransform placed(const SceneObject& object, const Asset& asset) {
  btTransform transform = placed(object);
  const Eigen::Vector3d start = startOf(object, asset);
  if (start.isZero(0)) return transform;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (const double degrees = object.rotationDegrees.norm(); degrees > 0)
    turn = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, object.rotationDegrees / degrees);
  const Eigen::Vector3d place = object.position + turn * start;
  if (place.cwiseAbs().maxCoeff() > limits::kPosition.high) {
    const Eigen::Vector3d middle = (asset.origin + asset.bounds().center()).array().round();
    throw Error("it would stand at " + shown(place) + " m, each must be " + limits::kPosition.text() +
                ": beyond, the floats of the world hold no centimetres; mesh_origin = " + shown(middle) +
                " puts its middle at its position");
  }
  transform.setOrigin(toBullet(place));
  return transform;
}

std::unique_ptr<btCollisionShape> makeShape(const SceneBody& def) {
  switch (def.shape) {
    case SceneBody::Shape::Sphere:
      return std::make_unique<btSphereShape>(btScalar(def.radius));
    case SceneBody::Shape::Box:
      return std::make_unique<btBoxShape>(toBullet(def.size / 2));
    case SceneBody::Shape::Plane:
      return std::make_unique<btStaticPlaneShape>(toBullet(def.normal.normalized()), btScalar(def.offset));
    case SceneBody::Shape::Hull:
      break;
  }
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3d& point : def.points) hull->addPoint(toBullet(point), false);
  hull->recalcLocalAabb();
  return hull;
}

DestructionDef destructionDef(const Scene& scene, const LogFunction& log) {
  DestructionDef def;
  def.precision = scene.precision;
  def.maxSubstepsPerFrame = scene.maxSubstepsPerFrame;
  def.substepSafety = scene.substepSafety;
  def.debris = scene.debris.has_value();
  def.maxDebris = scene.debris ? scene.debris->budget : 0;
  def.maxEvents = scene.maxEvents;
  def.fragmentBodyElements = scene.fragmentBodyElements;
  def.maxNewBodies = scene.maxNewBodies;
  def.sleep = scene.sleep;
  def.breaking = scene.breaking;
  def.crushing = scene.crushing;
  def.seed = scene.seed;
  def.log = inWordsOfTheScene(log);
  return def;
}

}  // namespace

World::World(const Scene& scene, const LogFunction& log)
    : m_scene(scene),
      m_world(std::make_unique<btDiscreteDynamicsWorld>(&m_dispatcher, &m_broadphase, &m_solver,
                                                        &m_configuration)),
      m_destruction(std::make_unique<Destruction>(*m_world, destructionDef(scene, log))) {
  m_world->setGravity(toBullet(scene.gravity));
  m_world->setInternalTickCallback(
      [](btDynamicsWorld* world, btScalar seconds) {
        static_cast<World*>(world->getWorldUserInfo())->finishTick(double(seconds));
      },
      this);
}

World::World(const Scene& scene, const Assets& assets, const LogFunction& log) : World(scene, log) {
  std::vector<Eigen::AlignedBox3d> bounds;
  for (std::size_t i = 0; i < assets.size(); ++i)
    bounds.push_back(assets[i]->bounds().translated(startOf(scene.objects[i], *assets[i])));
  adviseOnDust(scene, bounds, log);
  for (const SceneBody& body : scene.statics) m_statics.push_back(addBody(body));
  for (const SceneBody& body : scene.impactors) addImpactor(body);
  StartingBodies starting{.objects = {}, .impactors = m_impactors, .statics = m_statics, .world = *m_world};
  for (std::size_t i = 0; i < assets.size(); ++i)
    refuseAt(scene, i, [&] {
      starting.objects.push_back({assets[i], bullet::toEigen(placed(scene.objects[i], *assets[i]))});
    });
  checkOverlaps(scene, starting, log);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    std::vector<std::string> others = whatSubstepsDependOn();
    if (const std::string& body = scene.objects[i].anchorBody; !body.empty()) others.push_back(body);
    refuseAt(
        scene, i, [&] { addObject(scene.objects[i], assets[i]); }, others);
  }
}

World::~World() {
  m_destruction.reset();
  for (int i = m_world->getNumCollisionObjects() - 1; i >= 0; --i) {
    btCollisionObject* object = m_world->getCollisionObjectArray()[i];
    m_world->removeCollisionObject(object);
    delete object;
  }
}

void World::addObject(const SceneObject& object, std::shared_ptr<const Asset> asset) {
  DestructibleBodyDef def;
  def.anchored = object.asset.empty() ? object.anchor || object.anchorBox : !asset->anchors.empty();
  def.transform = placed(object, *asset);
  def.asset = std::move(asset);
  def.material = object.material;
  def.model = object.model;
  def.velocity = toBullet(object.velocity);
  def.spin = toBullet(object.spin);
  def.anchorBody = bodyNamed(object.anchorBody);
  def.massDamping = object.massDamping;
  def.regime = object.regime;
  m_destruction->addBody(def);
}

btRigidBody* World::bodyNamed(const std::string& path) const {
  if (const auto i = entryNamed(path, "impactors", m_impactors.size())) return m_impactors[*i];
  if (const auto i = entryNamed(path, "statics", m_statics.size())) return m_statics[*i];
  return nullptr;
}

btRigidBody* World::addBody(const SceneBody& def) {
  btCollisionShape* shape = m_shapes.emplace_back(makeShape(def)).get();
  const btScalar mass = btScalar(def.mass);
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
  info.m_startWorldTransform = placed(def);
  info.m_friction = btScalar(def.friction);
  info.m_restitution = btScalar(def.restitution);
  auto* body = new btRigidBody(info);  // deleted with the world
  m_world->addRigidBody(body);
  return body;
}

btRigidBody* World::addImpactor(const SceneBody& def) {
  btRigidBody* body = m_impactors.emplace_back(addBody(def));
  body->setLinearVelocity(toBullet(def.velocity));
  body->setAngularVelocity(toBullet(def.spin));
  return body;
}

void World::step() {
  m_substeps = 0;
  m_simulated = 0;
  const int mostTicks = int(std::ceil(m_scene.bulletRate / m_scene.fps)) + 1;
  try {
    m_world->stepSimulation(btScalar(1 / m_scene.fps), mostTicks, btScalar(1 / m_scene.bulletRate));
  } catch (const Error& error) {
    throw RunStopped(inWordsOfTheScene(error.what()));
  }
  if (!m_destruction->failure().empty()) throw RunStopped(inWordsOfTheScene(m_destruction->failure()));
}

void World::finishTick(double seconds) {
  const int substeps = m_destruction->lastSubsteps();
  m_substeps += substeps;
  m_simulated += seconds;
  m_substepLength = m_substeps > 0 ? m_simulated / m_substeps : 0;
}

std::uint64_t World::hash() const {
  base::Fnv1a hash;
  hash.add(m_destruction->hash());
  for (int i = 0; i < m_world->getNumCollisionObjects(); ++i) {
    const btCollisionObject* object = m_world->getCollisionObjectArray()[i];
    if (!btRigidBody::upcast(object)) continue;
    // That of a body of elements tells nothing that those do not.
    const DestructibleBody* body = DestructibleBody::upcast(object);
    const btTransform pose =
        body && !body->isWhole() ? btTransform::getIdentity() : object->getWorldTransform();
    for (int row = 0; row < 3; ++row) {
      // Three of Bullet's four scalars: the last one is padding.
      for (int column = 0; column < 3; ++column) hash.add(pose.getBasis()[row][column]);
      hash.add(pose.getOrigin()[row]);
    }
  }
  return hash.value();
}

}  // namespace rubble::demo
