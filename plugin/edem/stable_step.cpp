#include "edem/stable_step.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rubble::edem {

namespace {

template <class Real>
void addSpringRates(const Body<Real>& body, std::size_t s, std::span<ElementRates> rates) {
  if (!body.state.intact[s]) return;
  const Spring<Real>& spring = body.state.springs[s];
  const auto add = [&](std::uint32_t i, double side) {
    const double quarter = double((Real(0.5) * spring.rest + Real(side) * spring.offset).squaredNorm());
    const double m = body.constants->mass[i], inertia = body.constants->inertia[i];
    rates[i].stiffness += double(spring.stiffness) / m +
                          (double(spring.stiffness) * quarter + double(spring.rotational)) / inertia;
    rates[i].damping += double(spring.damping) / m +
                        (double(spring.damping) * quarter + double(spring.rotationalDamping)) / inertia;
  };
  add(spring.first, 1);
  if (!body.isAnchor(s)) add(spring.second, -1);
}

}  // namespace

template <class Real>
void springRates(const Body<Real>& body, std::span<ElementRates> rates) {
  assert(rates.size() == body.elementCount());
  std::fill(rates.begin(), rates.end(), ElementRates{});
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) addSpringRates(body, s, rates);
}

template <class Real>
void awakeSpringRates(const Body<Real>& body, std::span<ElementRates> rates) {
  assert(rates.size() == body.elementCount());
  std::fill(rates.begin(), rates.end(), ElementRates{});
  for (const std::uint32_t s : body.work.awakeSprings) addSpringRates(body, s, rates);
}

ElementRates contactRates(const ContactLaw<double>& law, double inverseMass, double inverseInertia,
                          double radius) {
  const double sliding = inverseMass + radius * radius * inverseInertia;
  return {std::max(law.stiffness * inverseMass, law.tangential * sliding + law.rolling * inverseInertia),
          std::max(law.damping * inverseMass,
                   law.tangentialDamping * sliding + law.rollingDamping * inverseInertia)};
}

void RateBound::add(const ElementRates& a, const ElementRates& b) {
  assert(a.stiffness >= 0 && a.damping >= 0 && b.stiffness >= 0 && b.damping >= 0);
  frequency2 = std::max(frequency2, a.stiffness + b.stiffness);
  damping = std::max(damping, a.damping + b.damping);
}

void RateBound::add(const RateBound& other) {
  frequency2 = std::max(frequency2, other.frequency2);
  damping = std::max(damping, other.damping);
}

double RateBound::stableStep() const {
  if (frequency2 <= 0) return std::numeric_limits<double>::infinity();
  const double omega = std::sqrt(frequency2);
  const double xi = damping / (2 * omega);
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

template <class Real>
RateBound springBound(const Body<Real>& body, std::span<const ElementRates> rates) {
  RateBound bound;
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    if (!body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    bound.add(rates[spring.first], body.isAnchor(s) ? ElementRates{} : rates[spring.second]);
  }
  return bound;
}

template void springRates(const Body<float>&, std::span<ElementRates>);
template void springRates(const Body<double>&, std::span<ElementRates>);
template void awakeSpringRates(const Body<float>&, std::span<ElementRates>);
template void awakeSpringRates(const Body<double>&, std::span<ElementRates>);
template RateBound springBound(const Body<float>&, std::span<const ElementRates>);
template RateBound springBound(const Body<double>&, std::span<const ElementRates>);

}  // namespace rubble::edem
