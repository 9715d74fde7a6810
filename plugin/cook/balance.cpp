#include "cook/balance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cook/polyhedron.h"

namespace rubble::cooking {
namespace {

// Farthest that an element moves, along each axis of the stretch and by the shift [r]. Solids of 64 elements
// and more, three across in each direction, were measured to need 0.12 to 0.29.
constexpr double kFarthest = 0.3;
// The same as a share of the cell's thickness: elements of thin sheets stay in them.
constexpr double kFarthestInCell = 0.25;
// What an asset allows is 0.5, see asset_distances.cpp [r].
constexpr double kApart = 0.51;
// Elements in a plane or on a line have no extent that could be stretched: below this share of the largest.
constexpr double kFlat = 1e-12;

// Of unit mass.
struct Mass {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  // mean of d d^T, d from the centre [m^2]
};

Mass massOf(const CheckedMesh& solid) {
  PolyhedronIntegrals integrals(solid.bounds.center());
  for (const auto& [a, b, c] : solid.triangles)
    integrals.add(solid.vertices[a], solid.vertices[b], solid.vertices[c]);
  return {integrals.centroid(), integrals.spread()};
}

// Of the places alone, each as a point.
Mass massOf(std::span<const CellMoments> cells, std::span<const Eigen::Vector3d> places) {
  Mass mass;
  double volume = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    mass.centre += cells[i].volume * places[i];
    volume += cells[i].volume;
  }
  mass.centre /= volume;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector3d arm = places[i] - mass.centre;
    mass.spread += cells[i].volume / volume * arm * arm.transpose();
  }
  return mass;
}

// What the elements' own inertia, the same about every axis, adds to the spread along each.
double ownSpread(std::span<const CellMoments> cells) {
  double sum = 0, volume = 0;
  for (const CellMoments& cell : cells) {
    sum += cell.volume * cell.gyration / 2;
    volume += cell.volume;
  }
  return sum / volume;
}

template <class Function>
Eigen::Matrix3d ofEigenvalues(const Eigen::Matrix3d& symmetric, Function&& function) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  return eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(function).asDiagonal() *
         eigen.eigenvectors().transpose();
}

// The symmetric S with S from S = to: of all maps that do so the one that moves mass the least (the optimal
// transport between two normal distributions [Olkin and Pukelsheim, The distance between two random vectors
// with given dispersion matrices, 1982]).
Eigen::Matrix3d leastStretch(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const auto root = [](double value) { return std::sqrt(std::max(value, 0.0)); };
  const double least = kFlat * from.trace();
  const Eigen::Matrix3d half = ofEigenvalues(from, root);
  const Eigen::Matrix3d inverseHalf =
      ofEigenvalues(from, [least](double value) { return value > least ? 1 / std::sqrt(value) : 0; });
  return inverseHalf * ofEigenvalues(half * to * half, root) * inverseHalf;
}

double farthestMove(const CellMoments& cell, double radius) {
  return std::min(kFarthest * radius, kFarthestInCell * cell.thickness);
}

// Without what would move an element too far.
Eigen::Matrix3d within(double radius, const Eigen::Matrix3d& stretch, const Eigen::Vector3d& centre,
                       std::span<const CellMoments> cells, std::span<const Eigen::Vector3d> places) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(stretch);
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();  // of a stretch by 1, over what is allowed
  for (std::size_t i = 0; i < places.size(); ++i)
    reach = reach.cwiseMax((eigen.eigenvectors().transpose() * (places[i] - centre)).cwiseAbs() /
                           farthestMove(cells[i], radius));
  Eigen::Vector3d factors = eigen.eigenvalues();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (!(std::abs(factors[axis] - 1) * reach[axis] <= 1)) factors[axis] = 1;
  return eigen.eigenvectors() * factors.asDiagonal() * eigen.eigenvectors().transpose();
}

bool areApart(std::span<const Eigen::Vector3d> places, double least) {
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&places](std::uint32_t a, std::uint32_t b) { return places[a].x() < places[b].x(); });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Eigen::Vector3d between = places[order[j]] - places[order[i]];
      if (between.x() >= least) break;
      if (between.norm() < least) return false;
    }
  return true;
}

std::vector<Eigen::Vector3d> centroidsOf(std::span<const CellMoments> cells) {
  std::vector<Eigen::Vector3d> centroids;
  for (const CellMoments& cell : cells) centroids.push_back(cell.centroid);
  return centroids;
}

}  // namespace

Balanced balance(const CheckedMesh& solid, std::span<const CellMoments> cells,
                 std::vector<Eigen::Vector3d> places, double radius) {
  const Mass wanted = massOf(solid);
  const double own = ownSpread(cells);
  Mass points = massOf(cells, places);
  double farthest = kFarthest * radius;
  for (const CellMoments& cell : cells) farthest = std::min(farthest, farthestMove(cell, radius));
  if (!((wanted.centre - points.centre).norm() <= farthest)) {
    std::vector<Eigen::Vector3d> centroids = centroidsOf(cells);
    if (areApart(centroids, kApart * radius)) {
      places = std::move(centroids);
      points = massOf(cells, places);
    }
  }

  if ((wanted.centre - points.centre).norm() <= farthest) {
    const Eigen::Matrix3d target = wanted.spread - own * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d stretch =
        within(radius, leastStretch(points.spread, target), points.centre, cells, places);
    std::vector<Eigen::Vector3d> moved;
    for (const Eigen::Vector3d& place : places)
      moved.push_back(wanted.centre + stretch * (place - points.centre));
    if (areApart(moved, kApart * radius)) places = std::move(moved);
  }

  const auto inertiaOf = [](const Eigen::Matrix3d& spread) {
    return Eigen::Matrix3d(spread.trace() * Eigen::Matrix3d::Identity() - spread);
  };
  points = massOf(cells, places);
  const Eigen::Matrix3d inertia = inertiaOf(wanted.spread);
  const Eigen::Matrix3d off = inertiaOf(points.spread + own * Eigen::Matrix3d::Identity()) - inertia;
  const double centreError = (points.centre - wanted.centre).norm() / solid.diagonal();
  return {std::move(places), centreError, off.norm() / inertia.norm()};
}

}  // namespace rubble::cooking
