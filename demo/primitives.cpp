#include "demo/primitives.h"

#include <algorithm>

#include "demo/column_mesh.h"
#include "demo/lathe.h"
#include "demo/slab_mesh.h"
#include "demo/statue_mesh.h"

namespace rubble::demo {
namespace {

// Chosen for the eye.
constexpr double kShaft = 0.6;   // [smaller of x and z]
constexpr double kPlinth = 0.1;  // [y]

SurfaceMesh scaled(SurfaceMesh mesh, const Eigen::Vector3d& factors) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(factors);
  return mesh;
}

// The tube is as thick as it is high; along z the ring is stretched.
SurfaceMesh torusOf(const SceneObject& object) {
  const Eigen::Vector3d& size = object.size;
  return scaled(torusMesh(size.x(), size.y(), object.segments), {1, 1, size.z() / size.x()});
}

}  // namespace

double shaftOf(const SceneObject& column) {
  return column.shaft > 0 ? column.shaft : kShaft * std::min(column.size.x(), column.size.z());
}

double plinthOf(const SceneObject& column) {
  return column.plinth > 0 ? column.plinth : kPlinth * column.size.y();
}

BrickCourse brickCourseOf(const SceneObject& object) {
  return {object.size, object.bricks, object.joint, object.offset};
}

SurfaceMesh primitiveMesh(const SceneObject& object) {
  switch (object.shape) {
    case SceneObject::Shape::Box:
      break;
    case SceneObject::Shape::Cylinder:
      return scaled(unitCylinder(object.segments), object.size);
    case SceneObject::Shape::Sphere:
      return scaled(unitSphere(object.segments), object.size);
    case SceneObject::Shape::Torus:
      return torusOf(object);
    case SceneObject::Shape::Column:
      return columnMesh({object.size, shaftOf(object), plinthOf(object), object.segments});
    case SceneObject::Shape::Slab:
      return slabMesh(object.size, object.openings);
    case SceneObject::Shape::Statue:
      return statueMesh(object.size);
    case SceneObject::Shape::BrickCourse:
      return brickCourseMesh(brickCourseOf(object));
  }
  return boxMesh(object.size);
}

}  // namespace rubble::demo
