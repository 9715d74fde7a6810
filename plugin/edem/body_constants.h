// What never changes of a body once it is made (make_body.cpp).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "edem/cell_faces.h"
#include "edem/contact.h"
#include "edem/criterion.h"
#include "edem/types.h"
#include "rubble/asset.h"
#include "rubble/material.h"

namespace rubble::edem {

/// A pair of elements whose contact distance is not simply 2 r: joined by a spring, or overlapping at rest.
struct PairIndex {
  std::uint32_t partner;
  std::uint32_t pair;  ///< into BodyState::range; below anchorBegin a spring's pair
};

inline constexpr std::uint32_t kNoPair = 0xffffffffu;

template <class Real>
struct BodyConstants {
  std::shared_ptr<const Asset> asset;
  Material material;
  Model model;
  double massDamping = 0;  ///< of the deformation velocity [1/s]

  // Elements.
  std::vector<double> mass;  ///< density x volume of the cell [kg]
  double lightest = 0;       ///< of them
  std::vector<Real> inverseMass;
  std::vector<double> inertia;  ///< scalar moment [kg m^2]
  std::vector<Real> inverseInertia;
  std::vector<Eigen::Vector3d> restCentred;  ///< X_I: rest positions about the centre of mass, asset axes [m]
  std::vector<Real> crushEnergy;             ///< W_I above which I is crushed [J], from eq. (4)

  // Springs, then anchors; their other constants are in BodyState::springs, beside what turns with the frame.
  std::vector<Eigen::Vector3d> springRest;    ///< d0, asset axes [m]
  std::vector<Eigen::Vector3d> springOffset;  ///< from the middle of d0 to where they act, asset axes [m]
  std::size_t anchorBegin = 0;                ///< springs[anchorBegin..] are anchors
  std::vector<std::uint32_t> springOffsets;   ///< CSR: the springs and anchors of each element
  std::vector<std::uint32_t> springsOf;
  std::vector<std::uint32_t> pairOffsets;  ///< CSR: partners of each element, sorted by partner
  std::vector<PairIndex> pairs;
  Criterion<Real> criterion{};
  ContactSide contact;  ///< of an element of mean mass; k_n = contactStiffness E h
  Real radius = 0;
  /// What rigid bodies touch; none: the elements' spheres.
  std::shared_ptr<const CellFaces> cells;
};

}  // namespace rubble::edem
