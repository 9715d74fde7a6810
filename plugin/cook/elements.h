// The elements of a solid: their radius and their places.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cook/checked_mesh.h"
#include "cook/packing.h"
#include "cook/restricted_voronoi.h"
#include "cook/signed_distance.h"
#include "rubble/error.h"

namespace rubble::cooking {

/// Spheres that still overlap deeper than this [2 r] after the relaxation are too many for the solid. Nearly
/// jammed but useful packings were measured at up to 0.11 (a wall 2.4 diameters thick, the ears of a bunny).
inline constexpr double kDeepestOverlap = 0.2;

struct Elements {
  double radius = 0;                                    ///< [m]
  std::vector<Eigen::Vector3d> centres;                 ///< [m], along a Hilbert curve
  std::vector<std::pair<LogLevel, std::string>> notes;  ///< for the log, if these elements are taken
};

/// Chooses the radius where it is not given, and fills the solid. Throws rubble::Error where the elements
/// wanted do not fit.
class Packer {
 public:
  /// `mesh` must outlive this. `progress` is told the share of one packing.
  Packer(const CheckedMesh& mesh, const CookOptions& options, std::function<void(double)> progress);

  /// What is to be said before the work, which may take minutes: how thick the thinnest walls are, where
  /// elements are thicker, and what would do. From places all over the surface; costs less than a packing.
  std::vector<std::pair<LogLevel, std::string>> foretell() const;
  /// Starts at random wherever a sphere fits: as dense as can be in a solid of one thickness, but parts
  /// thinner than the elements stay empty.
  Elements fill();
  /// Starts at equal distances all over the solid, thin parts too. Where elements have no room the radius,
  /// if it was not given, shrinks to half at most; those that still have none protrude.
  Elements fillEvenly() const;
  /// Moves one element into each part of the solid that the diagram, cut with these elements, lists as
  /// empty: those with the least cells, but none that is alone in its part. False: there is none to move.
  bool fillEmptyParts(const RestrictedVoronoi& diagram, Elements& elements) const;

 private:
  Elements fillAsTold();
  Packing packWith(double radius, std::span<const Room> start) const;
  Packing packCount(std::size_t count, double radius, std::span<const Room> start) const;
  bool doFit(std::size_t count, double radius) const;
  std::size_t mostThatFit(double radius) const;
  std::vector<Room> startPlaces(double radius) const;
  double radiusInThinParts(const std::vector<double>& rooms, double radius) const;
  bool fits(const Packing& packing) const;
  void requireFit(const Packing& packing, double radius) const;
  std::string whatFits(double radius) const;
  std::string whatFills(double radius) const;
  std::string whatHolds(double room) const;
  Eigen::Vector3d justBelow(const SurfacePlace& surface) const;
  Room farthestRoom(const std::vector<SurfacePlace>& places, const Elements& elements,
                    std::uint32_t element) const;
  void makeApart(double nearest, Elements& elements) const;
  Elements finish(Packing packing, double radius) const;
  void noteShrink(LogLevel level, double radius, Elements& elements) const;
  double wantedRadius() const;

  const CheckedMesh& m_mesh;
  CookOptions m_options;
  const bool m_isCountChosen;
  const std::function<void(double)> m_progress;
  const std::unique_ptr<SignedDistance> m_distance;
};

}  // namespace rubble::cooking
