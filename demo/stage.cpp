#include "demo/stage.h"

#include <LinearMath/btConvexHullComputer.h>
#include <epoxy/gl.h>

#include <array>
#include <numbers>

#include "demo/bullet_eigen.h"
#include "demo/picture_scale.h"

namespace rubble::demo {
namespace {

RendererDef rendererDef() {
  RendererDef def;
  def.shaderDirectory = shaderFolder().string();
  return def;
}

Lighting lighting(const SceneLight& light) {
  Lighting lighting;
  lighting.sunDirection = -light.direction.cast<float>();
  lighting.skyAmbient *= float(light.ambient);
  lighting.groundAmbient *= float(light.ambient);
  return lighting;
}

struct HullMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

HullMesh hullMesh(const btConvexHullShape& shape) {
  btConvexHullComputer hull;
  hull.compute(&shape.getUnscaledPoints()[0].x(), sizeof(btVector3), shape.getNumPoints(), 0, 0);
  HullMesh mesh;
  for (int i = 0; i < hull.vertices.size(); ++i) mesh.vertices.push_back(toEigen(hull.vertices[i]));
  for (int face = 0; face < hull.faces.size(); ++face) {
    const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[face]];
    const auto fan = std::uint32_t(first->getSourceVertex());
    for (auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace()) {
      mesh.triangles.push_back(
          {fan, std::uint32_t(edge->getSourceVertex()), std::uint32_t(edge->getTargetVertex())});
    }
  }
  return mesh;
}

}  // namespace

Stage::Stage(const World& world, const Scene& scene)
    : m_renderer(rendererDef()), m_lighting(lighting(scene.light)) {
  addBodies(world);
  measure(world);
  m_grain = grainScale(m_bounds.isEmpty() ? 0 : m_bounds.diagonal().norm());
  m_lighting.grainScale = m_grain;
  for (const btRigidBody* body : world.statics()) addProp(*body);
  update(world);
  // With bodies the renderer's own choice is right: what flies off them casts shadows.
  if (m_bodies.empty() && !m_bounds.isEmpty()) m_lighting.shadowBounds = m_bounds;
}

// Those that have come since, too. By their numbers, of which one has no body where that was removed.
void Stage::addBodies(const World& world) {
  for (const DestructibleBody* body : world.destruction().bodies()) {
    if (body->id() < m_bodies.size()) continue;
    m_bodies.resize(std::size_t(body->id()) + 1);
    m_bodies.back() = m_renderer.addBody(*body->asset(), body->model().cellJoining);
  }
}

// Crushed elements stay where they fell to pieces; debris is what the bodies were.
void Stage::measure(const World& world) {
  m_bounds.setEmpty();
  for (const DestructibleBody* body : world.destruction().bodies()) {
    m_poses.resize(body->asset()->elementCount());
    body->poses(m_poses);
    Eigen::AlignedBox3f box;
    const bool isPart = body->source() != body->id();  // without those that others have
    for (const ElementPose& pose : m_poses)
      if (!isPart || pose.alive > 0) box.extend(pose.position);
    if (box.isEmpty()) continue;
    const Eigen::Vector3f radius = Eigen::Vector3f::Constant(float(body->asset()->radius));
    m_bounds.extend(Eigen::AlignedBox3f(box.min() - radius, box.max() + radius));
  }
  for (const auto& list : {world.statics(), world.impactors()}) {
    for (const btRigidBody* body : list) {
      if (body->getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE) continue;
      btVector3 low, high;
      body->getAabb(low, high);
      m_bounds.extend(Eigen::AlignedBox3f(toEigen(low), toEigen(high)));
    }
  }
}

void Stage::addProp(const btRigidBody& body) {
  const btCollisionShape& shape = *body.getCollisionShape();
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      m_props.push_back({&body,
                         m_renderer.addSphere(float(static_cast<const btSphereShape&>(shape).getRadius())),
                         btTransform::getIdentity()});
      break;
    case BOX_SHAPE_PROXYTYPE:
      m_props.push_back(
          {&body,
           m_renderer.addBox(toEigen(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin())),
           btTransform::getIdentity()});
      break;
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const HullMesh mesh = hullMesh(static_cast<const btConvexHullShape&>(shape));
      m_props.push_back(
          {&body, m_renderer.addHull(mesh.vertices, mesh.triangles), btTransform::getIdentity()});
      break;
    }
    default:
      addPlane(body);
  }
}

// The level ground is endless; a tilted plane is drawn as a wide thin slab.
void Stage::addPlane(const btRigidBody& body) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(*body.getCollisionShape());
  const btVector3 normal = body.getWorldTransform().getBasis() * plane.getPlaneNormal();
  constexpr btScalar kLevel = btScalar(0.999999);  // cosine of the largest tilt that the ground hides
  if (normal.y() > kLevel) {
    const btVector3 point = body.getWorldTransform() * (plane.getPlaneNormal() * plane.getPlaneConstant());
    m_ground = float(point.y());
    m_renderer.addGroundPlane(*m_ground);
    return;
  }
  const float halfWidth = 20 * m_grain, halfThickness = 0.01f * m_grain;  // [m]
  const btVector3 centre = plane.getPlaneNormal() * (plane.getPlaneConstant() - btScalar(halfThickness));
  const btTransform inBody(shortestArcQuat(btVector3(0, 1, 0), plane.getPlaneNormal()), centre);
  m_props.push_back({&body, m_renderer.addBox({halfWidth, halfThickness, halfWidth}), inBody});
}

void Stage::update(const World& world) {
  for (; m_impactorsShown < world.impactors().size(); ++m_impactorsShown)
    addProp(*world.impactors()[m_impactorsShown]);
  addBodies(world);
  measure(world);
  for (const Prop& prop : m_props) {
    const btTransform pose = prop.body->getWorldTransform() * prop.inBody;
    m_renderer.setPropPose(prop.id, toEigen(pose.getOrigin()), toEigen(pose.getRotation()));
  }
  for (const DestructibleBody* body : world.destruction().bodies()) {
    m_poses.resize(body->asset()->elementCount());
    body->poses(m_poses);
    m_renderer.updateBody(m_bodies[body->id()], m_poses, body->springsIntact());
  }
  m_debris.clear();
  for (const DebrisPiece& piece : world.destruction().debris()) {
    m_debris.push_back({piece.position, piece.scale, piece.orientation, m_bodies[piece.body], piece.element});
  }
  m_renderer.setDebris(m_debris);
}

void Stage::showDust(const DustGrid* dust, double opacity) {
  DustLook look;
  look.opacity = float(opacity);
  m_renderer.setDust(dust, look);
}

void Stage::draw(const Camera& camera, const FrameTarget& target) {
  m_lighting.haze = hazeOf(camera.eye, m_bounds, m_grain);
  m_renderer.draw(withPlanes(camera, m_bounds, m_ground, m_grain, m_lighting.haze), m_lighting, target);
}

Camera sceneCamera(const SceneCamera& camera) {
  Camera result;
  result.eye = camera.eye.cast<float>();
  result.target = camera.target.cast<float>();
  result.verticalFov = float(camera.fieldOfViewDegrees * std::numbers::pi / 180);
  return result;
}

Renderer3D currentRenderer() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name && isSoftwareRenderer(name) ? Renderer3D::Software : Renderer3D::Hardware;
}

}  // namespace rubble::demo
