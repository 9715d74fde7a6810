#include "demo/stability/case_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bullet/convert.h"
#include "demo/stability/grid_asset.h"
#include "rubble/cook.h"

namespace rubble::stability {

using bullet::toBullet;

namespace {

constexpr double kShortestTick = 1e-3, kLongestTick = 1.0 / 15;  // [s]

// Bullet's gyroscopic term takes the product of three inertias, which for hills is more than a float holds.
void calmGyroscope(btRigidBody& body) {
  if (std::pow(double(body.getLocalInertia().length()), 3) > double(std::numeric_limits<float>::max()))
    body.setFlags(body.getFlags() & ~BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
}

// Numbers of cubes along x, y, z for about so many elements.
std::array<int, 3> cubesOf(Shape shape, int elements) {
  const auto root = [&](double power, double share) {
    return std::max(1, int(std::lround(share * std::pow(double(elements), power))));
  };
  switch (shape) {
    case Shape::Plate: {
      const int edge = root(0.5, 1);
      return {edge, 1, edge};
    }
    case Shape::Needle:
      return {1, elements, 1};
    case Shape::Sliver:
      return {2, 1, root(1, 0.5)};
    default: {
      const int edge = root(1.0 / 3, 1);
      return {edge, edge, edge};
    }
  }
}

}  // namespace

CaseWorld::CaseWorld(const Case& c, Engine engine) : m_case(c), m_engine(engine) {
  if (engine == Engine::Rubble)
    m_bullet.destruction = std::make_unique<Destruction>(m_bullet.world, definition());
  m_bullet.world.setGravity({0, btScalar(-c.gravity), 0});
  m_bullet.ground->setFriction(btScalar(c.friction));
  m_bullet.ground->setRestitution(btScalar(c.restitution));
}

DestructionDef CaseWorld::definition() {
  DestructionDef def;
  def.precision = m_case.precision;
  def.breaking = m_case.breaking;
  def.maxSubstepsPerFrame = maxSubsteps(m_case);
  def.maxDebris = 2000;
  def.log = [this](LogLevel level, const std::string& line) {
    if (level == LogLevel::Warning) m_warnings.push_back(line);
  };
  return def;
}

std::shared_ptr<const Asset> CaseWorld::asset(int elements, bool anchored) const {
  const double edge = 2 * m_case.radius;
  if (m_case.shape == Shape::Packed) {
    CookOptions options;
    options.elements = std::size_t(std::clamp(elements, 1, 60));
    if (anchored) options.anchorDirection = Eigen::Vector3d(0, -1, 0);
    const double side = edge * std::cbrt(double(options.elements));
    return std::make_shared<const Asset>(cook(boxMesh({side, side, side}, {0, 0.5 * side, 0}), options));
  }
  const std::array<int, 3> cubes = cubesOf(m_case.shape, elements);
  return std::make_shared<const Asset>(
      gridAsset({.cubes = cubes,
                 .edge = edge,
                 .origin = {-0.5 * edge * cubes[0], 0, -0.5 * edge * cubes[2]},
                 .anchored = anchored}));
}

void CaseWorld::addDestructible(const std::shared_ptr<const Asset>& asset, const Material& material,
                                const btVector3& at, const btVector3& velocity, double spin, bool anchored) {
  if (m_engine == Engine::Stock) return addStock(*asset, material, at, velocity, spin, anchored);
  DestructibleBodyDef def;
  def.asset = asset;
  def.material = material;
  if (m_case.paper) def.model = Model::paper();
  def.transform.setOrigin(at);
  if (!anchored) {
    def.velocity = velocity;
    def.spin = btScalar(spin) * btVector3(btScalar(0.6), 0, btScalar(0.8));
  }
  def.massDamping = m_case.massDamping;
  def.anchored = anchored;
  def.regime = m_case.regime;
  const double before = m_bullet.destruction->ledger().elastic;
  const DestructibleBody* body = m_bullet.destruction->addBody(def);
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < asset->elementCount(); ++i) {
    const double m = material.density * asset->volumes[i];
    mass += m;
    centre += m * asset->positions[i];
    m_lightest = m_lightest > 0 ? std::min(m_lightest, m) : m;
  }
  m_mass += mass;
  m_elementsPut += std::max(0.0, m_bullet.destruction->ledger().elastic - before);
  if (body->isWhole()) return;
  const Eigen::Vector3d v(double(def.velocity.x()), double(def.velocity.y()), double(def.velocity.z())),
      w(double(def.spin.x()), double(def.spin.y()), double(def.spin.z()));
  centre /= mass;
  for (std::size_t i = 0; i < asset->elementCount(); ++i) {
    const Eigen::Vector3d own = v + w.cross(asset->positions[i] - centre);
    m_elementsPut += 0.5 * material.density * asset->volumes[i] *
                     (own.squaredNorm() + asset->gyrations[i] * w.squaredNorm());
  }
}

void CaseWorld::addStock(const Asset& asset, const Material& material, const btVector3& at,
                         const btVector3& velocity, double spin, bool anchored) {
  const Eigen::AlignedBox3d box = asset.bounds();
  double mass = 0;
  for (const double volume : asset.volumes) mass += material.density * volume;
  m_mass += mass;
  m_shapes.push_back(std::make_unique<btBoxShape>(toBullet(0.5 * box.sizes())));
  btRigidBody* body =
      m_bullet.add(anchored ? 0 : btScalar(mass), *m_shapes.back(), at + toBullet(box.center()));
  calmGyroscope(*body);
  body->setFriction(btScalar(material.friction));
  body->setRestitution(btScalar(material.restitution));
  if (!anchored) {
    body->setLinearVelocity(velocity);
    body->setAngularVelocity(btScalar(spin) * btVector3(btScalar(0.6), 0, btScalar(0.8)));
  }
  m_stock.push_back(body);
}

void CaseWorld::build() {
  const auto own = asset(m_case.elements, m_case.anchored);
  const Eigen::AlignedBox3d box = own->bounds();
  // Far away along x and z, a hundredth of a radius above the ground unless it is tied to it.
  const double far = m_case.distance / std::sqrt(2.0);
  const Eigen::Vector3d at(far, m_case.anchored ? 0 : 0.01 * m_case.radius, far);
  m_middle = box.center() + at;
  m_half = 0.5 * box.sizes();
  addDestructible(own, materialOf(m_case), toBullet(at), {0, 0, 0}, m_case.spin, m_case.anchored);
  if (m_case.impactor == Impactor::Destructible) {
    addOtherBody();
  } else if (m_case.impactor != Impactor::None) {
    addImpactor();
  }
}

// Of a quarter of the elements and a hundredth or hundred times the stiffness, on top of the first.
void CaseWorld::addOtherBody() {
  Material m = materialOf(m_case);
  const double factor = m_case.massRatio < 1 ? 0.01 : 3;
  m.youngsModulus *= factor;
  m.tensileStrength *= m_case.strength == Strength::Infinite ? 1 : factor;
  m.compressiveStrength *= m_case.strength == Strength::Infinite ? 1 : factor;
  m.density = std::clamp(m.density * m_case.massRatio, 100.0, 20000.0);
  m.friction = 0.3;
  const Eigen::Vector3d at = m_middle + Eigen::Vector3d(0, m_half.y() + 0.01 * m_case.radius, 0);
  addDestructible(asset(std::max(1, m_case.elements / 4), false), m, toBullet(at),
                  {0, btScalar(-m_case.speed), 0}, 0, false);
}

void CaseWorld::addImpactor() {
  const double half = m_case.size * m_case.radius;
  const auto h = btScalar(half);
  std::unique_ptr<btCollisionShape> shape;
  Eigen::Vector3d at = m_middle, towards(0, 0, 1);
  double gap = 0.1 * m_case.radius + 1.5 * m_case.speed * m_case.frameStep;
  switch (m_case.impactor) {
    case Impactor::Box:
    case Impactor::Kinematic:
      shape = std::make_unique<btBoxShape>(btVector3(h, h, h));
      break;
    case Impactor::Plate:
      shape = std::make_unique<btBoxShape>(
          btVector3(btScalar(m_half.x() + half), btScalar(0.2 * m_case.radius), btScalar(m_half.z() + half)));
      towards = {0, -1, 0};
      gap = 0.01 * m_case.radius;
      break;
    case Impactor::Capsule:
      shape = std::make_unique<btCapsuleShape>(h, 2 * h);
      break;
    case Impactor::Cylinder:
      shape = std::make_unique<btCylinderShape>(btVector3(h, 2 * h, h));
      break;
    default:
      shape = std::make_unique<btSphereShape>(h);
      break;
  }
  const double thick = m_case.impactor == Impactor::Plate ? 0.2 * m_case.radius : half;
  at -= towards * (std::abs(towards.dot(m_half)) + thick + gap);
  if (m_case.impactor != Impactor::Plate) at.y() = std::max(at.y(), 2.1 * half);
  const bool kinematic = m_case.impactor == Impactor::Kinematic;
  const double mass = kinematic ? 0 : m_case.massRatio * elementMass(m_case);
  m_mass += mass;
  m_shapes.push_back(std::move(shape));
  m_impactor = m_bullet.add(btScalar(mass), *m_shapes.back(), toBullet(at));
  calmGyroscope(*m_impactor);
  // Bullet pushes bodies out of each other with energy of its own: what meets the elements does not meet the
  // ground.
  m_impactor->setIgnoreCollisionCheck(m_bullet.ground, true);
  m_impactor->setFriction(btScalar(m_case.friction));
  m_impactor->setRestitution(btScalar(m_case.restitution));
  if (kinematic) {
    m_impactor->setCollisionFlags(m_impactor->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    m_impactor->setActivationState(DISABLE_DEACTIVATION);
  }
  m_impactor->setLinearVelocity(toBullet(m_case.speed * towards));
  if (m_case.size < 3) m_impactor->setAngularVelocity({btScalar(m_case.spin), 0, 0});
}

double CaseWorld::stepOf(int tick) const {
  if (!m_case.jumping) return m_case.frameStep;
  constexpr std::array<double, 7> kJumps = {1, 4, 0.25, 2, 1, 0.25, 3};
  return std::clamp(m_case.frameStep * kJumps[std::size_t(tick) % kJumps.size()], kShortestTick,
                    kLongestTick);
}

void CaseWorld::step(double dt) {
  if (m_impactor && m_impactor->isKinematicObject()) {
    btTransform at = m_impactor->getWorldTransform();
    at.setOrigin(at.getOrigin() + btVector3(0, 0, btScalar(m_case.speed * dt)));
    m_impactor->setWorldTransform(at);
  }
  m_bullet.world.stepSimulation(btScalar(dt), 1, btScalar(dt));
}

std::vector<btRigidBody*> CaseWorld::bodies() const {
  if (!m_bullet.destruction) return m_stock;
  const auto& bodies = m_bullet.destruction->bodies();
  return {bodies.begin(), bodies.end()};
}

std::vector<const btRigidBody*> CaseWorld::healthy() const {
  std::vector<const btRigidBody*> list = {m_bullet.ground};
  if (m_impactor && !m_spoiled) list.push_back(m_impactor);
  const std::vector<btRigidBody*> all = bodies();
  list.insert(list.end(), all.begin() + (m_bodySpoiled ? 1 : 0), all.end());
  return list;
}

std::vector<const btRigidBody*> CaseWorld::moved() const {
  std::vector<const btRigidBody*> list;
  if (m_impactor && !m_spoiled && m_impactor->getInvMass() > 0) list.push_back(m_impactor);
  if (m_bodySpoiled) return list;
  for (const btRigidBody* body : m_stock)
    if (body->getInvMass() > 0) list.push_back(body);
  if (m_bullet.destruction)
    for (const DestructibleBody* body : m_bullet.destruction->bodies())
      if (body->isWhole() && body->getInvMass() > 0) list.push_back(body);
  return list;
}

const btRigidBody* CaseWorld::kinematic() const {
  return m_impactor && m_impactor->isKinematicObject() ? m_impactor : nullptr;
}

double CaseWorld::elementsPut() const {
  return m_elementsPut;
}
double CaseWorld::lightest() const {
  return m_lightest;
}
double CaseWorld::roundedEnergy() const {
  constexpr double kEpsilon = std::numeric_limits<float>::epsilon();
  return 4 * kEpsilon * m_mass * m_case.gravity * (m_case.distance + 100 * m_case.radius);
}

}  // namespace rubble::stability
