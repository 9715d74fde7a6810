// A Bullet world that counts what its steps take.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include "bullet/convert.h"
#include "demo/report_case.h"
#include "rubble/destruction.h"

namespace rubble::demo {

/// Nothing in it sleeps unless it is told to.
class CaseWorld {
 public:
  /// `gravity` along -y [m/s^2].
  explicit CaseWorld(double gravity);
  ~CaseWorld();
  CaseWorld(const CaseWorld&) = delete;
  CaseWorld& operator=(const CaseWorld&) = delete;

  /// Stands still where `mass` is 0. It meets nothing unless it `collides`.
  btRigidBody& add(double mass, std::unique_ptr<btCollisionShape> shape, const Eigen::Vector3d& at,
                   bool collides = true);
  void join(std::unique_ptr<btTypedConstraint> constraint);
  /// Springs do not break in it unless they are told to. Once a world.
  Destruction& destruct(Precision precision, double substepSafety, bool sleep = false, bool breaking = false);

  /// One tick of Bullet of that length [s].
  void step(double seconds);

  btDiscreteDynamicsWorld& world() { return m_world; }
  /// Of all steps so far, with this error.
  CaseOutcome outcome(double error) const { return {error, m_processorSeconds, m_simulatedSeconds}; }

 private:
  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btDbvtBroadphase m_broadphase;
  btSequentialImpulseConstraintSolver m_solver;
  std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
  std::vector<std::unique_ptr<btRigidBody>> m_bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> m_constraints;
  btDiscreteDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
  std::unique_ptr<Destruction> m_destruction;
  double m_processorSeconds = 0, m_simulatedSeconds = 0;
};

/// A box about the origin in that many elements, with kCaseSeed; cooked once a program.
std::shared_ptr<const Asset> cookedBox(const Eigen::Vector3d& size, std::size_t elements,
                                       const std::optional<Eigen::Vector3d>& anchorDirection = {});

/// Of all elements, at rest in their world's axes or moved [m].
std::vector<Eigen::Vector3d> placesOf(const DestructibleBody& body);

using bullet::toBullet;

/// Runs of the elements in both precisions, each at the default share of the stable substep and at those
/// parts of it; `run` gets precision and share. `quantity` goes before the method's name where it is not
/// empty.
std::vector<CaseRun> substepRuns(const std::string& quantity,
                                 const std::function<CaseOutcome(Precision, double)>& run,
                                 std::initializer_list<double> parts = {0.5, 0.25});

/// A run of so many elements; `method` goes behind the precision. Neither standard nor quick.
CaseRun elementsRun(Precision precision, const std::string& method, double safety, std::size_t elements,
                    std::function<CaseOutcome()> run);

/// Runs of a chain of Bullet's at each number of iterations, which name the method, and each rate [Hz]; those
/// of 10 are quick.
std::vector<CaseRun> chainRuns(const std::string& joint, std::initializer_list<int> iterations,
                               std::initializer_list<double> rates,
                               const std::function<CaseOutcome(double rate, int iterations)>& run);

/// "float" or "double".
std::string precisionName(Precision precision);

}  // namespace rubble::demo
