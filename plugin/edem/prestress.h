// The static state of an anchored body under gravity, so that it stands still from its first step without any
// damping.
#pragma once

#include "edem/body.h"

namespace rubble::edem {

/// Solves K (u, theta) = (m g, 0) by sparse Cholesky (Eigen), corrects the small finite-rotation residual
/// with the same factor, and writes displacements and rotations. Fragments without an anchor have no static
/// state: then nothing is done and false returned. `residual` (if given) receives the largest remaining force
/// over the weight of an element, dimensionless.
template <class Real>
bool prestress(Body<Real>& body, const Eigen::Vector3d& gravity, double* residual = nullptr);

}  // namespace rubble::edem
