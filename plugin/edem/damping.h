// Taking motion out of bodies between ticks, with what was taken booked.
#pragma once

#include <span>

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// Damps the deformation velocity of each fragment at `rate` [1/s] for `dt` seconds: what is left after its
/// rigid motion (mean velocity and spin) is taken away, so free fall and flight are not braked. What anchors
/// hold has no rigid motion, and its anchors take the momentum.
template <class Real>
void dampDeformation(Body<Real>& body, double rate, double dt, Books& books);
/// The same, each fragment at a rate of its own: rates[i] of that whose lowest element is i.
template <class Real>
void dampDeformation(Body<Real>& body, std::span<const double> rates, double dt, Books& books);

/// Takes a share of its motion from an element that comes to rest, all as it falls asleep.
template <class Real>
void brake(Body<Real>& body, std::uint32_t element, double share, Books& books);
/// Stops all elements of a body that falls asleep.
template <class Real>
void bookSlept(Body<Real>& body, Books& books);

}  // namespace rubble::edem
