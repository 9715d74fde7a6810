// Fragments that become bodies of their own.
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bullet/body_impl.h"
#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

// Each body has arrays of all elements of its asset: no more than this many times those of the first.
constexpr std::uint32_t kMostShares = 64;

// What the application has said of a body that is there for all that comes of it.
void takeSettings(DestructibleBody& from, const btVector3& gravity, DestructibleBody& to) {
  implOf(to).settings = implOf(from).settings;
  implOf(to).settings.gravity = bullet::ownGravity(from, gravity).value_or(bullet::noGravity());
  to.setCollisionFlags(from.getCollisionFlags());
  to.setFriction(from.getFriction());
  to.setRollingFriction(from.getRollingFriction());
  to.setSpinningFriction(from.getSpinningFriction());
  to.setRestitution(from.getRestitution());
  to.setLinearFactor(implOf(from).fixed ? implOf(from).freeLinear : from.getLinearFactor());
  to.setAngularFactor(implOf(from).fixed ? implOf(from).freeAngular : from.getAngularFactor());
  implOf(to).settings.linearFactor = to.getLinearFactor();
  implOf(to).settings.angularFactor = to.getAngularFactor();
  for (int i = 0; i < from.getNumObjectsWithoutCollision(); ++i)
    if (const btCollisionObject* ignored = from.getObjectWithoutCollision(i); ignored != &from)
      to.setIgnoreCollisionCheck(ignored, true);
}

}  // namespace

// Of a body that no anchor holds the heaviest fragment is what is left of it.
std::vector<std::uint32_t> Destruction::Impl::fragmentsToSplit(const DestructibleBody& body) {
  const edem::BodyView view = solver->view(body.id());
  if (view.asleep || view.fragments < 2 || implOf(body).jointed || body.isWhole()) return {};
  fragmentSizes.assign(view.fragment.size(), {});
  for (std::size_t i = 0; i < view.fragment.size(); ++i) {
    if (view.fragment[i] == kNoElement) continue;
    bullet::FragmentSize& size = fragmentSizes[view.fragment[i]];
    ++size.elements;
    size.mass += view.mass[i];
  }
  const auto heaviest = std::ranges::max_element(fragmentSizes, {}, &bullet::FragmentSize::mass);
  const auto stays = view.anchorsIntact > 0 ? kNoElement : std::uint32_t(heaviest - fragmentSizes.begin());
  const std::uint32_t least =
      std::max(def.fragmentBodyElements, std::uint32_t(view.fragment.size()) / kMostShares);
  std::vector<std::uint32_t> roots;
  for (std::uint32_t root = 0; root < fragmentSizes.size(); ++root)
    if (fragmentSizes[root].elements >= least && root != stays) roots.push_back(root);
  return roots;
}

void Destruction::Impl::splitBodies() {
  if (def.fragmentBodyElements == 0 || !failure.empty()) return;
  BT_PROFILE("Rubble split bodies");
  const std::size_t most = bodies.size() + def.maxNewBodies;
  for (std::size_t b = 0, old = bodies.size(); b < old; ++b)
    for (const std::uint32_t root : fragmentsToSplit(*bodies[b])) {
      if (bodies.size() == most) return;
      splitBody(*bodies[b], root);
    }
}

void Destruction::Impl::splitBody(DestructibleBody& body, std::uint32_t root) {
  const std::optional<std::uint32_t> id = solver->split(body.id(), root);
  if (!id) return;
  const DestructibleBody::Impl& from = implOf(body);
  auto impl = std::make_unique<DestructibleBody::Impl>();
  impl->id = *id;
  impl->source = from.source;
  impl->asset = from.asset;
  impl->material = from.material;
  impl->model = from.model;
  impl->name = "body " + std::to_string(*id) + " (of " + from.name + ")";
  impl->spawner = std::make_unique<debris::Spawner>(from.material, from.model, def.seed);
  impl->bondConstants = from.bondConstants;
  impl->wasRoot.assign(from.wasRoot.size(), 0);
  impl->wasRoot[root] = 1;
  const bullet::FragmentSize size = fragmentSizes[root];
  DestructibleBody* part = make(std::move(impl), size.mass);
  takeSettings(body, world.getGravity(), *part);
  bullet::beElements(*part);
  showElements(*part);
  const btBroadphaseProxy& filter = *body.getBroadphaseProxy();
  enter(*part, filter.m_collisionFilterGroup, filter.m_collisionFilterMask);
  record(events[filling].bodiesSplit, {body.id(), *id, root, size.elements, float(size.mass)});
}

RUBBLE_ABI_END
}  // namespace rubble
