// What the application is told of a tick.
#include <LinearMath/btQuickprof.h>

#include <algorithm>

#include "bullet/body_impl.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

// Resting debris within this many radii of a break wake up.
constexpr double kWakeRadii = 3;

}  // namespace

// For applications that read manifolds: a body's impulse, in equal parts on the points of its manifold.
void Destruction::Impl::writeAppliedImpulses() {
  BT_PROFILE("Rubble write applied impulses");
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const bool second = upcastElements(manifold.getBody1()) != nullptr;
    const DestructibleBody* own = upcastElements(second ? manifold.getBody1() : manifold.getBody0());
    if (!own) continue;
    const btCollisionObject* other = second ? manifold.getBody0() : manifold.getBody1();
    for (std::size_t p = 0; p < proxies.size(); ++p) {
      const edem::RigidProxy& proxy = proxies[p];
      if (touched[p].object != other ||
          std::count(proxy.touched.begin(), proxy.touched.end(), own->id()) == 0)
        continue;
      const double share = 1.0 / double(proxy.touched.size()) / std::max(1, manifold.getNumContacts());
      for (int c = 0; c < manifold.getNumContacts(); ++c)
        manifold.getContactPoint(c).m_appliedImpulse =
            btScalar(share * (proxy.impulse - proxy.anchorImpulse).norm());
    }
  }
}

void Destruction::Impl::bookEvents() {
  BT_PROFILE("Rubble book events");
  Events& out = events[filling];
  const edem::TickReport& report = solver->report();
  wakeBoxes.clear();
  for (const edem::BrokenSpring& s : report.broken) {
    record(out.springsBroken, {s.body, s.spring, s.mode, float(s.energy), s.position.cast<float>()});
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kWakeRadii * solver->radius(s.body));
    wakeBoxes.emplace_back(s.position - reach, s.position + reach);
  }
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    const edem::RigidProxy& proxy = proxies[p];
    if (!(proxy.contactWeight > 0)) continue;
    for (const std::uint32_t id : proxy.touched)
      record(out.contacts, {id, touched[p].object, float((proxy.impulse - proxy.anchorImpulse).norm()),
                            (proxy.contactPoint / proxy.contactWeight).cast<float>()});
  }
  for (DestructibleBody* body : bodies) {
    const auto broke = [&](const edem::BrokenSpring& s) { return s.body == body->id(); };
    if (std::none_of(report.broken.begin(), report.broken.end(), broke)) continue;
    const edem::BodyView view = solver->view(body->id());
    std::vector<FragmentSplit> split(view.fragment.size());
    for (std::size_t i = 0; i < view.fragment.size(); ++i) {
      if (view.fragment[i] == kNoElement) continue;
      FragmentSplit& f = split[view.fragment[i]];
      ++f.elements;
      f.mass += float(view.mass[i]);
    }
    for (std::uint32_t i = 0; i < split.size(); ++i) {
      const bool root = view.fragment[i] == i;
      if (root && !implOf(*body).wasRoot[i])
        record(out.fragmentsSplit, {body->id(), i, split[i].elements, split[i].mass});
      implOf(*body).wasRoot[i] = root;
    }
  }
}

RUBBLE_ABI_END
}  // namespace rubble
