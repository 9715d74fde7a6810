#include "edem/calm.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "edem/rigid_motion.h"

namespace rubble::edem {
namespace {

// U = k/2 |dx|^2 with the force k |dx| = sigma A, so that sigma^2 = 2 k U / A^2. A moment's stress is judged
// by its energy too, which is up to three times what the same stress takes in tension: on the safe side.
template <class Real>
double largestStress(const Body<Real>& body) {
  double most2 = 0;
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    if (!body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    const double energy = double(load.stretchEnergy) + double(load.rotationEnergy),
                 area = double(spring.area);
    most2 = std::max(most2, 2 * double(spring.stiffness) * energy / (area * area));
  }
  return std::sqrt(most2);
}

}  // namespace

template <class Real>
Unrest unrestOf(const Body<Real>& body) {
  assert(body.state.fragmentCount == 1);
  Unrest all;
  RigidMotion whole;
  if (body.state.anchorsIntact == 0) whole = rigidMotions(body).begin()->second;
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.state.alive[i]) continue;
    const double radius = double(body.constants->radius);
    const Eigen::Vector3d v =
        body.state.velocity[i].template cast<double>() - whole.at(body.worldPosition(i));
    const Eigen::Vector3d w = body.state.spin[i].template cast<double>() - whole.spin;
    all.trembling = std::max(all.trembling, v.norm() + radius * w.norm());
    const double arm = (body.worldPosition(i) - whole.centre).norm() + radius;
    all.speed = std::max(all.speed, whole.velocity.norm() + arm * whole.spin.norm());
    Vec3<Real> from = body.state.displacement[i];
    if (!body.state.parkedAt.empty()) from -= body.state.parkedAt[i];
    all.deformation = std::max(all.deformation, double(from.norm()));
  }
  all.stress = largestStress(body) / double(body.constants->criterion.tension);
  return all;
}

template Unrest unrestOf(const Body<float>&);
template Unrest unrestOf(const Body<double>&);

}  // namespace rubble::edem
