// Taking motion out of bodies between ticks, with what was taken booked.
#pragma once

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// Damps the deformation velocity of each fragment at `rate` [1/s] for `dt` seconds: what is left after its
/// rigid motion (mean velocity and spin) is taken away, so free fall and flight are not braked.
template <class Real>
void dampDeformation(Body<Real>& body, double rate, double dt, Books& books);

/// Stops all elements of a body that falls asleep.
template <class Real>
void bookSlept(Body<Real>& body, Books& books);

}  // namespace rubble::edem
