// Fills a solid with equal spheres: paper 3.1.1, steps 2 to 5.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cook/room.h"
#include "cook/signed_distance.h"

namespace rubble::cooking {

struct PackingDef {
  std::size_t count = 0;
  double radius = 0;  ///< [m]
  std::uint64_t seed = 0;
  double maxOverlap = 0;  ///< where the relaxation may end [2 r]
  int maxIterations = 0;
  /// Where the elements start, one each; empty: at random where a sphere fits. Those that start with less
  /// room than the radius keep it: they may protrude where the solid is thinner than they are.
  std::span<const Room> start = {};
};

struct Packing {
  std::vector<Eigen::Vector3d> centres;  ///< fewer than wanted: no sphere of this radius fits anywhere
  double deepestOverlap = 0;             ///< [2 r]
  double deepestProtrusion = 0;          ///< out of the solid [m]
  double deepestPlace = 0;  ///< where centres are missing: the largest distance from the surface found [m]
  /// Where centres are missing: half of the places on the surface have a deeper one behind them [m]. Elements
  /// of this radius fit nearly everywhere, those of `deepestPlace` perhaps in a single corner.
  double usualDepth = 0;
  int iterations = 0;
  std::vector<double> rooms;  ///< how deep below the surface each is held [m], at most the radius
};

/// Random start where a sphere fits, then overdamped contact moves and pushes back inside until the spheres
/// hardly overlap. The paper integrates its contact force law; at rest both end in the same state, and this
/// needs no time step. A lattice would pack faster but leaves planes of weakness. `progress` is told the
/// share done: at each element that looks for room, and at each iteration.
Packing pack(const SignedDistance& distance, const Eigen::AlignedBox3d& bounds, const PackingDef& def,
             const std::function<void(double)>& progress);

}  // namespace rubble::cooking
