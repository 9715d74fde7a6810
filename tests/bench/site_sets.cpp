#include "bench/site_sets.h"

#include <algorithm>
#include <cmath>

#include "cook/polyhedron.h"
#include "cook/random.h"
#include "cook/restricted_voronoi.h"
#include "cook/signed_distance.h"

namespace rubble::test {
namespace {

using cooking::CheckedMesh;
using cooking::SignedDistance;

// Of a cubic cell [its edge].
struct Lattice {
  Sites corners;
  double layer;  // from one layer of places to the next
};

// Those inside, of a lattice about the middle, or half a layer beside it along the thinnest axis.
Sites latticeSites(const CheckedMesh& solid, const SignedDistance& distance, const Lattice& lattice,
                   double edge, bool isBeside) {
  const Eigen::Array3i half =
      (solid.bounds.sizes().array() / (2 * edge)).ceil().cast<int>() + 1;  // cells to either side
  Eigen::Vector3d origin = solid.bounds.center();
  Eigen::Index thinnest = 0;
  solid.bounds.sizes().minCoeff(&thinnest);
  if (isBeside) origin[thinnest] += edge * lattice.layer / 2;
  Sites sites;
  for (int i = -half[0]; i < half[0]; ++i)
    for (int j = -half[1]; j < half[1]; ++j)
      for (int k = -half[2]; k < half[2]; ++k)
        for (const Eigen::Vector3d& corner : lattice.corners) {
          const Eigen::Vector3d place = origin + edge * (Eigen::Vector3d(i, j, k) + corner);
          if (solid.bounds.contains(place) && distance.exact(place).value < 0) sites.push_back(place);
        }
  return sites;
}

// Of edges around that of an endless solid, and of both places of the layers, what comes nearest to the
// count.
Sites fittedLattice(const CheckedMesh& solid, const Lattice& lattice, std::size_t count) {
  constexpr int kSteps = 20;  // of a hundredth, to either side
  const auto distance = cooking::signedDistance(solid);
  const double usual = std::cbrt(solid.volume * double(lattice.corners.size()) / double(count));
  Sites best;
  const auto miss = [count](const Sites& sites) { return std::abs(double(sites.size()) - double(count)); };
  for (const bool isBeside : {false, true})
    for (int step = -kSteps; step <= kSteps; ++step) {
      Sites sites = latticeSites(solid, *distance, lattice, usual * (1 + 0.01 * step), isBeside);
      if (best.empty() || miss(sites) < miss(best)) best = std::move(sites);
    }
  return best;
}

}  // namespace

Sites cubicSites(const CheckedMesh& solid, std::size_t count) {
  return fittedLattice(solid, {{Eigen::Vector3d::Constant(0.5)}, 1}, count);
}

Sites faceCentredSites(const CheckedMesh& solid, std::size_t count) {
  const Sites corners = {{0.25, 0.25, 0.25}, {0.25, 0.75, 0.75}, {0.75, 0.25, 0.75}, {0.75, 0.75, 0.25}};
  return fittedLattice(solid, {corners, 0.5}, count);
}

Sites randomSites(const CheckedMesh& solid, std::size_t count) {
  const auto distance = cooking::signedDistance(solid);
  cooking::Random random(1);
  Sites sites;
  while (sites.size() < count) {
    Eigen::Vector3d place = solid.bounds.min();
    for (int axis = 0; axis < 3; ++axis) place[axis] += random.uniform() * solid.bounds.sizes()[axis];
    if (distance->exact(place).value < 0) sites.push_back(place);
  }
  return sites;
}

Sites lloydSites(const CheckedMesh& solid, std::size_t count, int iterations) {
  Sites sites = randomSites(solid, count);
  const double jitter = 1e-6 * std::cbrt(solid.volume / double(count));
  for (int k = 0; k < iterations; ++k) {
    const auto diagram = cooking::restrictedVoronoi(solid, sites, jitter, 1, {});
    for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
      cooking::PolyhedronIntegrals integrals(diagram.sites[cell]);
      diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
      });
      sites[cell] = integrals.centroid();
    }
  }
  return sites;
}

}  // namespace rubble::test
