// Plane cuts through a solid, and what beam theory needs of them. Computed once a body.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// A field that is linear in place, such as the acceleration in a rigid body: offset + slope x.
struct LinearField {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
};

/// Forces on one side of a cut: their sum [N] and their moment about the origin [N m].
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  Wrench& operator+=(const Wrench& other);
};

/// Zeroth to second moments about the origin of weights that are spread over space: kilograms, or square
/// metres of anchored surface.
struct SpreadWeight {
  double weight = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< sum of weight x place
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum of weight x place x place^T
  /// Adds a weight about `at` whose scalar moment of inertia about its own centre is `inertia`.
  void add(double added, const Eigen::Vector3d& at, double inertia);
  /// Of the forces weight x field.
  Wrench under(const LinearField& field) const;
  /// Moment of inertia about the origin.
  Eigen::Matrix3d inertia() const;
};

/// The surface of a cut across axis a; its plane's axes are u = (a + 1) mod 3 and v = (a + 2) mod 3.
struct Section {
  int axis = 0;
  double at = 0;                                       ///< coordinate along that axis [m]
  double area = 0;                                     ///< [m^2]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m]
  double uu = 0, vv = 0, uv = 0;                       ///< second moments about the centroid [m^4]
  double twist = 0;                  ///< torque over the largest shear stress it makes [m^3]
  std::vector<Eigen::Vector2d> rim;  ///< outermost points in sixteen directions, from the centroid [m]
  SpreadWeight mass, anchors;        ///< of what lies beyond: centres of elements, tied points
};

/// Cuts across each axis of a body, at equal distances.
inline constexpr int kCutsPerAxis = 7;
inline constexpr std::size_t kCuts = 3 * kCutsPerAxis;

struct Sections {
  std::array<Section, kCuts> cuts;
  SpreadWeight mass, anchors;        ///< of the whole
  double spacing = 0;                ///< of the elements [m]
  double length = 0, thickness = 0;  ///< largest and least extent along an axis [m]
};

/// In the axes of `frame` (in the asset's), about the origin `centre` of that frame. Masses and scalar
/// moments of inertia of the elements [kg], [kg m^2] (n).
Sections sectionsOf(const Asset& asset, const Eigen::Isometry3d& frame, const Eigen::Vector3d& centre,
                    std::span<const double> masses, std::span<const double> inertias);

RUBBLE_ABI_END
}  // namespace rubble::bullet
