// What a crushed element leaves: its debris (paper section 3.2) and its dust (section 3.3), with momentum,
// spin and energy accounted for.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "base/crushed_element.h"
#include "debris/motion.h"
#include "debris/size_distribution.h"
#include "rubble/asset.h"
#include "rubble/material.h"

namespace rubble::debris {

/// A piece at birth. It is a parcel of equal grains of radius R: air drag sees a grain, momentum the whole
/// mass.
struct DebrisParcel {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();    ///< of it from the centre of its element [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< [rad/s]
  double mass = 0;                                 ///< [kg], > 0
  double inertia = 0;                              ///< scalar, about its centre [kg m^2], >= 0
  double radius = 0;                               ///< R [m], > 0
  double collisionRadius = 0;                      ///< of the ball that collides [m]; 0 is a point
  double density = 0;                              ///< of the grains [kg/m^3], > 0
  double friction = 0;                             ///< Coulomb mu, dimensionless, >= 0
  double scale = 0;                                ///< of the cell mesh when drawn, dimensionless
  std::uint32_t body = 0;
  std::uint32_t element = 0;
};

/// All that one crushed element became.
struct DebrisBatch {
  std::vector<DebrisParcel> pieces;
  double dustShare = 0;  ///< P of eq. (6), dimensionless
  Motion piecesMotion;   ///< sum over `pieces`
  /// The share P of the element's mass, momenta and kinetic energy. The dust leaves the centre at the
  /// element's velocity; its share of the spin goes with it.
  Motion dustMotion;
  /// Kinetic energy of pieces and dust less the element's [J]. With conservation on it is at most
  /// releasedEnergy: so much of that went to the debris. It can be a little below 0 for a lopsided cell that
  /// turned: its pieces then keep the angular momentum at less energy.
  double energyGiven = 0;
};

/// Breaks the elements of one material. Holds scratch memory: one per thread.
class Spawner {
 public:
  /// Throws rubble::Error when a number of the material that debris need is out of range. `seed` is of the
  /// sizes.
  Spawner(const Material& material, const Model& model, std::uint64_t seed);

  /// Memory for cells of up to this many faces; `spawn` allocates only for a cell with more.
  void reserve(std::size_t faces, DebrisBatch& batch);

  /// Fills `batch` with as many pieces as the cell has faces (one for a cell without any); none when all is
  /// dust. Throws rubble::Error when the element's state is not finite or it has no mass.
  ///
  /// `conserveDebris` off (the paper): every piece starts at the centre with v + s n, n the face's normal and
  /// s = debrisSpeed |v|; drawn at R / 2r; a point to collisions. This makes momentum out of nothing for a
  /// cell whose normals do not cancel, and energy for every cell; the spin is lost.
  ///
  /// `conserveDebris` on (DEVIATION, default): piece n starts at centre + (face centroid - centre) / 2 + a
  /// common shift that keeps the centre of mass, with v + w x offset + its scattering velocity. From the
  /// scattering s n the mean linear and angular momentum are removed, and it is scaled down until pieces and
  /// dust have at most the element's kinetic energy plus releasedEnergy. The angular momentum that the places
  /// do not carry is in the pieces' spin. Drawn at R / r_cell, r_cell = (3 V / 4 pi)^(1/3), and a ball of
  /// radius R to collisions.
  void spawn(const base::CrushedElement& element, std::span<const CellFace> faces, DebrisBatch& batch);

 private:
  void makePieces(const base::CrushedElement& element, std::span<const CellFace> faces, DebrisBatch& batch);
  void scatterFromCentre(const base::CrushedElement& element, DebrisBatch& batch) const;
  void scatterConserving(const base::CrushedElement& element, DebrisBatch& batch);

  Material m_material;
  Model m_model;
  std::uint64_t m_seed;
  // One entry a piece.
  std::vector<PieceSize> m_sizes;
  std::vector<double> m_masses;               // [kg]
  std::vector<Eigen::Vector3d> m_offsets;     // from the element's centre [m]
  std::vector<Eigen::Vector3d> m_velocities;  // relative to the element's centre [m/s]
};

}  // namespace rubble::debris
