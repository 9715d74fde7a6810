#include "edem/body_queries.h"

#include <algorithm>
#include <span>

namespace rubble::edem {

template <class Real>
RateBound bodyBound(const Body<Real>& body) {
  std::vector<ElementRates> rates(body.elementCount());
  springRates(body, std::span(rates));
  RateBound bound = springBound(body, std::span<const ElementRates>(rates));
  // Any element may press another, or a rigid body, beside its springs.
  const ContactLaw<double> law = contactLaw(body.constants->contact, body.constants->contact);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    ElementRates contact = rates[i];
    const ElementRates one = contactRates(law, 1 / body.constants->mass[i], 1 / body.constants->inertia[i],
                                          double(body.constants->radius));
    contact.stiffness += one.stiffness;
    contact.damping += one.damping;
    bound.add(contact, {});
  }
  return bound;
}

template <class Real>
double speedOf(const Body<Real>& b, const Eigen::Vector3d& drift) {
  const Vec3<Real> common = drift.cast<Real>();
  double fastest = 0;
  for (const std::uint32_t i : b.work.awake)
    if (b.state.alive[i])
      fastest = std::max(fastest, double((b.state.velocity[i] - common).norm()) +
                                      double(b.constants->radius) * double(b.state.spin[i].norm()));
  return fastest;
}

template <class Real>
Eigen::AlignedBox3d boundsOf(const Body<Real>& b) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < b.elementCount(); ++i)
    if (b.state.alive[i]) box.extend(b.worldPosition(i));
  if (box.isEmpty()) return box;
  box.min().array() -= b.reach();
  box.max().array() += b.reach();
  return box;
}

template <class Real>
void elementsIn(const Body<Real>& body, const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& out) {
  out.clear();
  for (std::uint32_t i = 0; i < body.elementCount(); ++i)
    if (body.state.alive[i] && box.contains(body.worldPosition(i))) out.push_back(i);
}

template <class Real>
void addTo(base::Fnv1a& hash, const Body<Real>& body) {
  hash.add(std::as_bytes(std::span<const Vec3<Real>>(body.state.displacement)));
  hash.add(std::as_bytes(std::span<const Vec3<Real>>(body.state.velocity)));
  hash.add(std::as_bytes(std::span<const Vec3<Real>>(body.state.spin)));
  hash.add(std::as_bytes(std::span<const Quat<Real>>(body.state.rotation)));
  hash.add(std::as_bytes(std::span<const std::uint8_t>(body.state.alive)));
  hash.add(std::as_bytes(std::span<const std::uint8_t>(body.state.intact)));
  hash.add(std::as_bytes(std::span<const std::uint32_t>(body.state.frameOf)));
  for (const Frame& f : body.state.frames) {
    hash.add(std::as_bytes(std::span<const double>(f.origin.data(), 3)));
    hash.add(std::as_bytes(std::span<const double>(f.turn.coeffs().data(), 4)));
  }
}

template RateBound bodyBound(const Body<float>&);
template RateBound bodyBound(const Body<double>&);
template double speedOf(const Body<float>&, const Eigen::Vector3d&);
template double speedOf(const Body<double>&, const Eigen::Vector3d&);
template Eigen::AlignedBox3d boundsOf(const Body<float>&);
template Eigen::AlignedBox3d boundsOf(const Body<double>&);
template void elementsIn(const Body<float>&, const Eigen::AlignedBox3d&, std::vector<std::uint32_t>&);
template void elementsIn(const Body<double>&, const Eigen::AlignedBox3d&, std::vector<std::uint32_t>&);
template void addTo(base::Fnv1a&, const Body<float>&);
template void addTo(base::Fnv1a&, const Body<double>&);

}  // namespace rubble::edem
