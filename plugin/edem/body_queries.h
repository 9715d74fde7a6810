// What can be asked of one body as it stands.
#pragma once

#include <vector>

#include "base/hash.h"
#include "edem/body.h"
#include "edem/stable_step.h"

namespace rubble::edem {

/// Rates of the springs and of one contact at every element.
template <class Real>
RateBound bodyBound(const Body<Real>& body);

/// Largest speed of an element's surface beside `drift` [m/s].
template <class Real>
double speedOf(const Body<Real>& body, const Eigen::Vector3d& drift = Eigen::Vector3d::Zero());

/// Of what rigid bodies touch of the living elements, world; empty if there are none [m].
template <class Real>
Eigen::AlignedBox3d boundsOf(const Body<Real>& body);

/// Living elements whose centre lies in the box now, in rising order. Looks at every element.
template <class Real>
void elementsIn(const Body<Real>& body, const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& out);

/// Adds the bits of the state.
template <class Real>
void addTo(base::Fnv1a& hash, const Body<Real>& body);

}  // namespace rubble::edem
