// Parts of the solid in which the packing has left no element get one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/groups.h"
#include "cook/elements.h"
#include "cook/hilbert.h"
#include "cook/message.h"
#include "cook/polyhedron.h"
#include "cook/room.h"
#include "cook/site_pieces.h"
#include "cook/springs.h"

namespace rubble::cooking {
namespace {

// From the smallest.
std::vector<std::uint32_t> cellsBySize(const RestrictedVoronoi& diagram) {
  std::vector<double> volumes;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    PolyhedronIntegrals integrals(diagram.sites[cell]);
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
    });
    volumes.push_back(integrals.volume());
  }
  std::vector<std::uint32_t> cells(diagram.cellCount());
  std::iota(cells.begin(), cells.end(), 0u);
  std::stable_sort(cells.begin(), cells.end(),
                   [&volumes](std::uint32_t a, std::uint32_t b) { return volumes[a] < volumes[b]; });
  return cells;
}

// Of the element's place from the nearest other one [m].
double distanceToOthers(const Elements& elements, std::uint32_t element, const Eigen::Vector3d& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t other = 0; other < elements.centres.size(); ++other)
    if (other != element) nearest = std::min(nearest, (elements.centres[other] - place).squaredNorm());
  return std::sqrt(nearest);
}

}  // namespace

// Into the solid, but not out of it again where it is thin.
Eigen::Vector3d Packer::justBelow(const SurfacePlace& surface) const {
  const Eigen::Vector3d& outwards = m_mesh.normals[surface.triangle];
  double below = 1e-3 * std::cbrt(m_mesh.volume);
  constexpr int kHalvings = 30;
  for (int k = 0; k < kHalvings; ++k, below /= 2) {
    // The surface is nowhere nearer than where it began.
    constexpr double kTouches = 0.999;
    if (m_distance->exact(surface.place - below * outwards).value <= -kTouches * below) break;
  }
  return surface.place - below * outwards;
}

// Of some places in an empty part the one farthest from all other elements.
Room Packer::farthestRoom(const std::vector<SurfacePlace>& places, const Elements& elements,
                          std::uint32_t element) const {
  constexpr std::size_t kMostPlaces = 64;
  const std::size_t step = 1 + (places.size() - 1) / kMostPlaces;
  Room best{};
  double farthest = -1;
  for (std::size_t k = 0; k < places.size(); k += step) {
    const Room room = findRoomNear(*m_distance, justBelow(places[k]), elements.radius);
    const double distance = distanceToOthers(elements, element, room.place);
    if (distance <= farthest) continue;
    farthest = distance;
    best = room;
  }
  return best;
}

bool Packer::fillEmptyParts(const RestrictedVoronoi& diagram, Elements& elements) const {
  base::Groups parts(diagram.cellCount());
  for (const AssetSpring& tie : findSprings(diagram, findSitePieces(diagram), 0))
    parts.join(tie.first, tie.second);
  std::vector<std::size_t> left(diagram.cellCount(), 0);
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) ++left[parts.of(cell)];

  std::size_t filled = 0;
  double deepest = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t cell : cellsBySize(diagram)) {
    if (filled == diagram.emptyParts.size()) break;
    if (left[parts.of(cell)] < 2) continue;
    --left[parts.of(cell)];
    const Room room = farthestRoom(diagram.emptyParts[filled++], elements, cell);
    elements.centres[cell] = room.place;
    deepest = std::max(deepest, elements.radius - room.depth);
    nearest = std::min(nearest, distanceToOthers(elements, cell, room.place));
  }
  if (filled == 0) return false;
  constexpr double kNoticed = 0.02;  // [radii]
  elements.notes.emplace_back(
      deepest > kNoticed * elements.radius ? LogLevel::Warning : LogLevel::Info,
      line(filled, filled == 1 ? " part" : " parts", " of the mesh had no element and ",
           filled == 1 ? "gets one" : "get one each", ", which protrudes by up to ", deepest, " m"));
  makeApart(nearest, elements);
  std::vector<Eigen::Vector3d> ordered;
  for (const std::uint32_t i : hilbertOrder(elements.centres)) ordered.push_back(elements.centres[i]);
  elements.centres = std::move(ordered);
  return true;
}

// An asset's elements are half a radius apart at least; those on both sides of a narrow gap may be nearer.
void Packer::makeApart(double nearest, Elements& elements) const {
  constexpr double kApart = 0.51;  // [radii]
  if (nearest >= kApart * elements.radius) return;
  const double radius = nearest / kApart;
  if (m_options.radius > 0)
    throw Error(line("parts of the mesh that do not touch have elements of radius ", elements.radius, " m ",
                     nearest, " m apart, must be half the radius and more; a radius of ", radius,
                     " m would do"));
  elements.radius = radius;
  noteShrink(LogLevel::Warning, radius, elements);
}

}  // namespace rubble::cooking
