#include "edem/rest_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "rubble/asset.h"

namespace rubble::edem {
namespace {

using Eigen::VectorXd;
using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

// Elements of a rigid group: smaller ones make the coarse factor dear, larger ones the iterations many.
constexpr std::size_t kGroupSize = 40;
// The sparse Cholesky of more groups than this costs more than the iterations that it saves (a cube of 131k
// elements: 11 s for 2000).
constexpr std::size_t kMostGroups = 1000;
// Steps of the smoother, and the share of the spectrum it is made for: what is below is the groups' part.
constexpr int kSmoothing = 3;
constexpr double kSpectrumShare = 1.0 / 10;
// A link's energy is at most twice what it has with either end held: so K <= 2 D for the diagonal blocks D.
constexpr double kLargest = 2;
constexpr int kMostIterations = 2000;

class DirectSolver final : public RestSolver {
 public:
  explicit DirectSolver(const RestStiffness& k) : m_factor(groupedStiffness(k, singleGroups(k))) {}
  bool ok() const { return m_factor.info() == Eigen::Success; }
  bool solve(const VectorXd& b, double, VectorXd& x) override {
    x = m_factor.solve(b);
    return x.allFinite();
  }

 private:
  Factor m_factor;
};

class GroupedSolver final : public RestSolver {
 public:
  explicit GroupedSolver(const RestStiffness& k)
      : m_k(k),
        m_groups(boxGroups(k, std::clamp<std::size_t>(k.elementCount() / kGroupSize, 1, kMostGroups))),
        m_factor(groupedStiffness(k, m_groups)),
        m_inverse(diagonalBlocks(k)) {
    for (Matrix6& block : m_inverse) block = block.ldlt().solve(Matrix6::Identity()).eval();
  }
  bool ok() const { return m_factor.info() == Eigen::Success; }
  int iterations() const override { return m_iterations; }
  bool solve(const VectorXd& b, double share, VectorXd& x) override;

 private:
  void precondition(const VectorXd& r, VectorXd& z);
  void smooth(const VectorXd& r, VectorXd& z, bool fromZero);
  void correct(const VectorXd& r, VectorXd& z);
  void jacobi(const VectorXd& r, VectorXd& out) const {
    out.resize(r.size());
    for (std::size_t i = 0; i < m_inverse.size(); ++i)
      out.segment<6>(6 * Eigen::Index(i)).noalias() = m_inverse[i] * r.segment<6>(6 * Eigen::Index(i));
  }

  const RestStiffness& m_k;
  RigidGroups m_groups;
  Factor m_factor;
  std::vector<Matrix6> m_inverse;  // of the diagonal blocks
  int m_iterations = 0;
  VectorXd m_left, m_step, m_image, m_jacobi;  // work space of the preconditioner
};

// z += the groups' answer to r - K z.
void GroupedSolver::correct(const VectorXd& r, VectorXd& z) {
  apply(m_k, z, m_image);
  m_left = r - m_image;
  VectorXd coarse = VectorXd::Zero(6 * Eigen::Index(m_groups.centre.size()));
  for (std::size_t i = 0; i < m_inverse.size(); ++i) {
    const std::uint32_t g = m_groups.of[i];
    if (g == kNoElement) continue;
    const auto own = m_left.segment<6>(6 * Eigen::Index(i));
    const Eigen::Vector3d force = own.head<3>();
    coarse.segment<3>(6 * Eigen::Index(g)) += force;
    coarse.segment<3>(6 * Eigen::Index(g) + 3) +=
        own.tail<3>() + (m_k.points[i] - m_groups.centre[g]).cross(force);
  }
  coarse = m_factor.solve(coarse).eval();
  for (std::size_t i = 0; i < m_inverse.size(); ++i) {
    const std::uint32_t g = m_groups.of[i];
    if (g == kNoElement) continue;
    const Eigen::Vector3d turn = coarse.segment<3>(6 * Eigen::Index(g) + 3);
    z.segment<3>(6 * Eigen::Index(i)) +=
        coarse.segment<3>(6 * Eigen::Index(g)) + turn.cross(m_k.points[i] - m_groups.centre[g]);
    z.segment<3>(6 * Eigen::Index(i) + 3) += turn;
  }
}

// Chebyshev iteration on D^-1 K z = D^-1 r for eigenvalues in [share, 1] x kLargest [Saad, Iterative Methods
// for Sparse Linear Systems, algorithm 12.1].
void GroupedSolver::smooth(const VectorXd& r, VectorXd& z, bool fromZero) {
  constexpr double middle = 0.5 * (1 + kSpectrumShare) * kLargest;
  constexpr double half = 0.5 * (1 - kSpectrumShare) * kLargest;
  constexpr double sigma = middle / half;
  double rho = 1 / sigma;
  for (int n = 0; n < kSmoothing; ++n) {
    if (n == 0 && fromZero) {
      jacobi(r, m_jacobi);
    } else {
      apply(m_k, z, m_image);
      m_left = r - m_image;
      jacobi(m_left, m_jacobi);
    }
    if (n == 0) {
      m_step = m_jacobi / middle;
    } else {
      const double next = 1 / (2 * sigma - rho);
      m_step = next * rho * m_step + (2 * next / half) * m_jacobi;
      rho = next;
    }
    if (n == 0 && fromZero) {
      z = m_step;
    } else {
      z += m_step;
    }
  }
}

// Smooth, correct, smooth: symmetric and definite.
void GroupedSolver::precondition(const VectorXd& r, VectorXd& z) {
  smooth(r, z, true);
  correct(r, z);
  smooth(r, z, false);
}

bool GroupedSolver::solve(const VectorXd& b, double share, VectorXd& x) {
  x = VectorXd::Zero(b.size());
  VectorXd r = b, z, image;
  precondition(r, z);
  VectorXd direction = z;
  double size2 = r.dot(z);
  const double enough2 = share * share * size2;
  for (int n = 0; n < kMostIterations && size2 > enough2; ++n) {
    apply(m_k, direction, image);
    const double curvature = direction.dot(image);
    if (!(curvature > 0)) return false;
    const double step = size2 / curvature;
    x += step * direction;
    r -= step * image;
    precondition(r, z);
    const double next2 = r.dot(z);
    direction = z + (next2 / size2) * direction;
    size2 = next2;
    ++m_iterations;
  }
  return x.allFinite() && size2 <= enough2;
}

template <class Solver>
std::unique_ptr<RestSolver> made(const RestStiffness& k) {
  auto solver = std::make_unique<Solver>(k);
  if (!solver->ok()) return nullptr;
  return solver;
}

}  // namespace

std::unique_ptr<RestSolver> directSolver(const RestStiffness& k) {
  return made<DirectSolver>(k);
}

std::unique_ptr<RestSolver> groupedSolver(const RestStiffness& k) {
  return made<GroupedSolver>(k);
}

}  // namespace rubble::edem
