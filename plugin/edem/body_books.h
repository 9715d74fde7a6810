// What a body brings into the books, and what it takes out of them.
#pragma once

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// Books a body that joins; the first one's centre is that of angular momentum.
template <class Real>
void bookNew(const Body<Real>& body, Books& books);

/// Books a body that leaves, with the energy of its contacts with other elements [J].
template <class Real>
void bookLeaving(const Body<Real>& body, double contactElastic, Books& books);

/// Elastic energy of a body's springs as they stand [J].
template <class Real>
double elasticOf(const Body<Real>& body);

/// Mass of its living elements [kg].
template <class Real>
double massOf(const Body<Real>& body);

/// Gives element i an impulse and one of rotation about its centre [N s], [N m s], and books it as the
/// host's.
template <class Real>
void pushElement(Body<Real>& body, std::size_t i, const Eigen::Vector3d& linear,
                 const Eigen::Vector3d& angular, Books& books);

}  // namespace rubble::edem
