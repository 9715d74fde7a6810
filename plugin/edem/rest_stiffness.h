// The stiffness K of a body's springs in a state near rest, as the static solve needs it: applied link by
// link, never stored as a matrix (36 numbers a pair of elements, where a link has 12).
//
// Unknowns are 6 an element: changes of the displacement u [m], then of the rotation theta [rad]. With h = R
// d0 / 2 at either end, the gap of a link changes by u_K - u_I - theta_I x h_I - theta_K x h_K and its
// relative rotation by theta_K - theta_I (edem/spring.h). The geometric stiffness (of the forces themselves)
// is left out, so that K is definite in any state.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

namespace rubble::edem {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// One unbroken spring; all in the asset's axes.
struct RestLink {
  std::uint32_t first, second;  ///< elements; second is kNoElement for an anchor
  double stiffness;             ///< k [N/m]
  double rotational;            ///< k_rot [N m]
  Eigen::Vector3d rest;         ///< d0 [m]
  Eigen::Vector3d offset;       ///< from the middle of d0 to where the spring acts [m]
  Eigen::Vector3d halfFirst;    ///< d0 / 2 + offset as the first element turns it [m]
  Eigen::Vector3d halfSecond;   ///< d0 / 2 - offset as the second turns it [m]
};

struct RestStiffness {
  std::vector<Eigen::Vector3d> points;  ///< rest positions, asset axes [m] (n)
  std::vector<RestLink> links;
  /// A lone chain without k_rot has modes without stiffness; a crushed element has none at all. A tiny
  /// diagonal keeps K definite and moves the solution by the same tiny share: kShift times the largest
  /// diagonal entry.
  double shift = 0;

  static constexpr double kShift = 1e-12;

  std::size_t elementCount() const { return points.size(); }
};

/// Sets `shift` from the links.
void setShift(RestStiffness& k);

/// out = K x. The sums are in the order of the links.
void apply(const RestStiffness& k, const Eigen::VectorXd& x, Eigen::VectorXd& out);

/// The 6x6 blocks on the diagonal of K (n).
std::vector<Matrix6> diagonalBlocks(const RestStiffness& k);

/// Elements that move together as one rigid body about `centre`.
struct RigidGroups {
  std::vector<std::uint32_t> of;        ///< group of each element (n); kNoElement: in none
  std::vector<Eigen::Vector3d> centre;  ///< [m] (number of groups)
};

/// Every element by itself.
RigidGroups singleGroups(const RestStiffness& k);

/// About `wanted` groups: boxes of equal size over the bounds of the elements, cut where the links inside of
/// a box do not connect them. Elements without a link are in no group.
RigidGroups boxGroups(const RestStiffness& k, std::size_t wanted);

/// P^T K P for the rigid motions P of the groups, lower half; links inside of a group drop out. With
/// singleGroups it is K itself.
Eigen::SparseMatrix<double> groupedStiffness(const RestStiffness& k, const RigidGroups& groups);

}  // namespace rubble::edem
