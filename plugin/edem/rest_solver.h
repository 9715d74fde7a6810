// Solves K x = b for the static state of a body: sparse Cholesky for small ones, above that conjugate
// gradients with two levels.
//
// The two levels are the elements, smoothed by Chebyshev polynomials of the block Jacobi iteration, and rigid
// groups of some dozens of elements (an aggregation with the six rigid motions of each), solved by sparse
// Cholesky. Rigid groups are exact for what bends over many elements, which block Jacobi alone would need
// thousands of iterations for. A sparse Cholesky of all elements is a hundred times slower and larger at 16k
// elements of a wall.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "edem/rest_stiffness.h"

namespace rubble::edem {

class RestSolver {
 public:
  virtual ~RestSolver() = default;
  /// Brings |b - K x| down to `share` of |b| or below, in the solver's own norm. False: it cannot.
  virtual bool solve(const Eigen::VectorXd& b, double share, Eigen::VectorXd& x) = 0;
  /// Iterations of all solves so far; 0 for a direct solver.
  virtual int iterations() const { return 0; }
};

/// Sparse Cholesky of K; null when K is not definite. Keep it below some thousand elements.
std::unique_ptr<RestSolver> directSolver(const RestStiffness& k);

/// Conjugate gradients; null when the groups' K is not definite. `k` must outlive it.
std::unique_ptr<RestSolver> groupedSolver(const RestStiffness& k);

}  // namespace rubble::edem
