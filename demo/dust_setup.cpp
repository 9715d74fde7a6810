#include "demo/dust_setup.h"

#include "demo/bullet_eigen.h"
#include "demo/input_error.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

DustGridDef gridDef(const Scene& scene, int threads) {
  const SceneDust& dust = *scene.dust;
  const Material material = scene.objects.empty() ? Material() : scene.objects.front().material;
  DustGridDef def;
  def.resolution = dust.resolution;
  def.min = dust.min.cast<float>();
  def.max = dust.max.cast<float>();
  def.grainRadius = float(material.dustRadius);
  def.grainDensity = float(material.density);
  def.gravity = float(-scene.gravity.y());
  def.vorticity = float(dust.vorticity);
  def.drag = float(dust.drag);
  def.pressureCycles = dust.pressureCycles;
  def.threads = threads;
  return def;
}

DustObstacle obstacle(const btRigidBody& body) {
  DustObstacle solid;
  const btCollisionShape& shape = *body.getCollisionShape();
  solid.orientation = toEigen(body.getOrientation());
  solid.velocity = toEigen(body.getLinearVelocity());
  solid.spin = toEigen(body.getAngularVelocity());
  btVector3 low, high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  solid.halfExtents = toEigen((high - low) / 2);
  solid.position = toEigen(body.getWorldTransform() * ((low + high) / 2));
  const bool round = shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE;
  solid.kind = round ? DustObstacle::Kind::Sphere : DustObstacle::Kind::Box;  // a hull fills about its box
  return solid;
}

}  // namespace

bool isSoftwareRenderer(const std::string& glRenderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast"})
    if (glRenderer.find(name) != std::string::npos) return true;
  return false;
}

std::unique_ptr<DustGrid> makeDust(const Scene& scene, Renderer3D renderer, int threads) {
  if (!scene.dust) return nullptr;
  DustBackend backend = scene.dust->backend;
  if (backend == DustBackend::Auto)
    backend = renderer == Renderer3D::Hardware ? DustBackend::Gl : DustBackend::Cpu;
  if (backend == DustBackend::Gl && renderer == Renderer3D::None) {
    throw InputError(scene.blamed("dust.backend"), "dust.backend",
                     "is \"gl\" in a run without pictures, must be auto or cpu there");
  }
  try {
    const DustGridDef def = gridDef(scene, threads);
    return backend == DustBackend::Gl ? createDustGridGl(def, shaderFolder().string())
                                      : createDustGridCpu(def);
  } catch (const MachineError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(scene.blamed("dust"), "dust", error.what());
  }
}

void findObstacles(const World& world, std::vector<DustObstacle>& out) {
  out.clear();
  for (const btRigidBody* body : world.impactors()) out.push_back(obstacle(*body));
}

}  // namespace rubble::demo
