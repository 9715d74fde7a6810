// The scene on screen: hands what the world and the dust grid hold to the renderer. Needs a current GL
// context.
#pragma once

#include <optional>
#include <vector>

#include "demo/dust_setup.h"
#include "demo/world.h"
#include "rubble/render.h"

namespace rubble::demo {

class Stage {
 public:
  Stage(const World& world, const Scene& scene);

  /// Takes over where everything is now.
  void update(const World& world);
  /// What is drawn as dust; null for none. The grid must live until the next call.
  void showDust(const DustGrid* dust, double opacity);
  /// The camera's planes are chosen here.
  void draw(const Camera& camera, const FrameTarget& target);

 private:
  struct Prop {
    const btRigidBody* body;
    PropId id;
    btTransform inBody;  // pose of the drawn prop in the body's frame
  };
  void addProp(const btRigidBody& body);
  void addPlane(const btRigidBody& body);
  void measure(const World& world);
  void addBodies(const World& world);

  Renderer m_renderer;
  Lighting m_lighting;
  std::vector<BodyId> m_bodies;  // by DestructibleBody::id()
  std::vector<Prop> m_props;
  std::size_t m_impactorsShown = 0;
  Eigen::AlignedBox3f m_bounds;  // of all solids as they are now, without planes [m]
  std::optional<float> m_ground;
  float m_grain = 1;
  std::vector<ElementPose> m_poses;
  std::vector<DebrisInstance> m_debris;
};

Camera sceneCamera(const SceneCamera& camera);

/// Whether the current GL context draws on a graphics card.
Renderer3D currentRenderer();

}  // namespace rubble::demo
