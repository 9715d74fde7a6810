#include "demo/cases/case_world.h"

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "demo/markdown_table.h"
#include "demo/processor_time.h"
#include "rubble/cook.h"

namespace rubble::demo {

CaseWorld::CaseWorld(double gravity) {
  m_world.setGravity({0, btScalar(-gravity), 0});
}

CaseWorld::~CaseWorld() {
  m_destruction.reset();
  for (const auto& constraint : m_constraints) m_world.removeConstraint(constraint.get());
  for (const auto& body : m_bodies) m_world.removeRigidBody(body.get());
  while (m_world.getNumCollisionObjects() > 0) {
    btCollisionObject* object = m_world.getCollisionObjectArray()[0];
    m_world.removeCollisionObject(object);
    delete object;
  }
}

btRigidBody& CaseWorld::add(double mass, std::unique_ptr<btCollisionShape> shape, const Eigen::Vector3d& at,
                            bool collides) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
  m_bodies.push_back(std::make_unique<btRigidBody>(
      btRigidBody::btRigidBodyConstructionInfo(btScalar(mass), nullptr, shape.get(), inertia)));
  m_shapes.push_back(std::move(shape));
  btRigidBody& body = *m_bodies.back();
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), toBullet(at)));
  body.setActivationState(DISABLE_DEACTIVATION);
  if (collides) {
    m_world.addRigidBody(&body);
  } else {
    m_world.addRigidBody(&body, 0, 0);
  }
  return body;
}

void CaseWorld::join(std::unique_ptr<btTypedConstraint> constraint) {
  m_constraints.push_back(std::move(constraint));
  m_world.addConstraint(m_constraints.back().get(), true);
}

Destruction& CaseWorld::destruct(Precision precision, double substepSafety, bool sleep, bool breaking) {
  DestructionDef def;
  def.precision = precision;
  def.substepSafety = substepSafety;
  def.breaking = breaking;
  def.crushing = false;
  def.sleep = sleep;
  m_destruction = std::make_unique<Destruction>(m_world, def);
  return *m_destruction;
}

void CaseWorld::step(double seconds) {
  const double start = processorTime();
  m_world.stepSimulation(btScalar(seconds), 0);
  m_processorSeconds += processorTime() - start;
  m_simulatedSeconds += seconds;
}

std::shared_ptr<const Asset> cookedBox(const Eigen::Vector3d& size, std::size_t elements,
                                       const std::optional<Eigen::Vector3d>& anchorDirection) {
  using Key = std::tuple<double, double, double, std::size_t, bool>;
  static std::map<Key, std::shared_ptr<const Asset>> cooked;
  std::shared_ptr<const Asset>& asset =
      cooked[{size.x(), size.y(), size.z(), elements, anchorDirection.has_value()}];
  if (!asset) {
    CookOptions options;
    options.elements = elements;
    options.seed = kCaseSeed;
    options.anchorDirection = anchorDirection;
    asset = std::make_shared<const Asset>(cook(boxMesh(size), options));
  }
  return asset;
}

std::vector<Eigen::Vector3d> placesOf(const DestructibleBody& body) {
  std::vector<ElementPose> poses(body.asset()->elementCount());
  body.poses(poses);
  std::vector<Eigen::Vector3d> places;
  for (const ElementPose& pose : poses) places.push_back(pose.position.cast<double>());
  return places;
}

std::string precisionName(Precision precision) {
  return precision == Precision::Float ? "float" : "double";
}

std::vector<CaseRun> substepRuns(const std::string& quantity,
                                 const std::function<CaseOutcome(Precision, double)>& run,
                                 std::initializer_list<double> parts) {
  const DestructionDef standard;
  std::vector<CaseRun> runs;
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    const std::string method =
        (quantity.empty() ? "" : quantity + ", ") + "elements, " + precisionName(precision);
    const auto add = [&](double safety, bool whole) {
      runs.push_back({method, "substep_safety " + rounded(safety), whole && precision == standard.precision,
                      whole, [=] { return run(precision, safety); }});
    };
    add(standard.substepSafety, true);
    for (const double part : parts) add(standard.substepSafety * part, false);
  }
  return runs;
}

CaseRun elementsRun(Precision precision, const std::string& method, double safety, std::size_t elements,
                    std::function<CaseOutcome()> run) {
  return {"elements, " + precisionName(precision) + ", " + method,
          std::to_string(elements) + " elements, substep_safety " + rounded(safety), false, false,
          std::move(run)};
}

std::vector<CaseRun> chainRuns(const std::string& joint, std::initializer_list<int> iterations,
                               std::initializer_list<double> rates,
                               const std::function<CaseOutcome(double rate, int iterations)>& run) {
  std::vector<CaseRun> runs;
  for (const int count : iterations)
    for (const double rate : rates)
      runs.push_back({"Bullet's " + joint + ", " + std::to_string(count) + " iterations",
                      rounded(rate) + " Hz", false, count == 10, [=] { return run(rate, count); }});
  return runs;
}

}  // namespace rubble::demo
