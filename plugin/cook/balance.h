// Places of the elements such that together they have the solid's centre of mass and moments of inertia.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

/// What an element stands for: its clipped cell.
struct CellMoments {
  double volume = 0;                                   ///< [m^3]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m]
  double gyration = 0;                                 ///< a third of the inertia's trace, of unit mass [m^2]
  double thickness = 0;  ///< of a box that spreads alike, along its thinnest axis [m]
};

struct Balanced {
  std::vector<Eigen::Vector3d> places;  ///< [m]
  double centreError = 0;               ///< distance of the centres, of the solid's diagonal
  double inertiaError = 0;              ///< Frobenius norm of the difference, of the norm of the solid's
};

/// Elements stand at `places` in the packing, and their cells reach farther on one side than on another: of a
/// cube of 2048 the inertia would be 2 % too small. Moves them as little as can be, in the mean square
/// weighed by volume: by one symmetric stretch and one shift of all, so that neighbours stay neighbours and
/// the lines between them stay all but square to their faces, which a uniform strain needs to be in balance.
/// Along axes on which an element would have to move by more than 0.3 `radius` or a quarter of its cell's
/// thickness, the stretch is left out: there the solid is too thin for elements whose own inertia is the same
/// about every axis. Where the shift alone is that far, which takes a handful of elements or cells much
/// larger than they, elements begin at the centroids of their cells. Where that does not reach, as of a cup
/// whose wall is thinner than its foot, each moves by the square of its own room instead, those of thin cells
/// hardly, if it then does. Elements do not come nearer to one
/// another than half a radius. (n each)
Balanced balance(const CheckedMesh& solid, std::span<const CellMoments> cells,
                 std::vector<Eigen::Vector3d> places, double radius);

}  // namespace rubble::cooking
