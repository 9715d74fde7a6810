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
// Centre and spread, of the solid's size: the rest is rounding.
constexpr double kExact = 1e-9;
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

double errorOf(const Mass& mass, const Mass& wanted) {
  const double size = wanted.spread.trace();
  return std::max((mass.centre - wanted.centre).norm() / std::sqrt(size),
                  (mass.spread - wanted.spread).norm() / size);
}

// The fields along which elements move, at q from their centre: three shifts and six stretches.
Eigen::Matrix<double, 3, 9> fieldsAt(const Eigen::Vector3d& q) {
  Eigen::Matrix<double, 3, 9> fields;
  fields << Eigen::Matrix3d::Identity(), Eigen::Matrix3d(q.asDiagonal()),
      (Eigen::Matrix3d() << q.y(), q.z(), 0, q.x(), 0, q.z(), 0, q.x(), q.y()).finished();
  return fields;
}

// Each element by a shift and a symmetric stretch times the square of its room: the moves that are the least
// in the mean square over that room (normal equations; 9 unknowns for 9 moments). One step of Newton's.
void moveByRoom(const Mass& points, const Mass& target, std::span<const CellMoments> cells, double radius,
                std::vector<Eigen::Vector3d>& places) {
  const Eigen::Vector3d shift = target.centre - points.centre;
  const Eigen::Matrix3d spread = (target.spread - points.spread) / 2;
  Eigen::Matrix<double, 9, 1> wanted;
  wanted << shift, spread.diagonal(), 2 * spread(0, 1), 2 * spread(0, 2), 2 * spread(1, 2);
  double volume = 0;
  for (const CellMoments& cell : cells) volume += cell.volume;
  Eigen::Matrix<double, 9, 9> moments = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double room = farthestMove(cells[i], radius) / radius;
    const auto fields = fieldsAt(places[i] - points.centre);
    moments += cells[i].volume / volume * room * room * fields.transpose() * fields;
  }
  const Eigen::Matrix<double, 9, 1> factors = moments.ldlt().solve(wanted);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double room = farthestMove(cells[i], radius) / radius;
    places[i] += room * room * fieldsAt(places[i] - points.centre) * factors;
  }
}

// What one stretch of all cannot do where thin cells stand beside thick ones: those with room move. Empty
// where that takes more room than there is.
std::vector<Eigen::Vector3d> balancedByRoom(const Mass& target, std::span<const CellMoments> cells,
                                            double radius, const std::vector<Eigen::Vector3d>& places) {
  constexpr int kSteps = 8;  // each squares the error
  std::vector<Eigen::Vector3d> moved = places;
  for (int step = 0; step < kSteps; ++step) {
    moveByRoom(massOf(cells, moved), target, cells, radius, moved);
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (!((moved[i] - places[i]).norm() <= farthestMove(cells[i], radius))) return {};
  }
  return areApart(moved, kApart * radius) ? moved : std::vector<Eigen::Vector3d>();
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

  const Mass target{wanted.centre, wanted.spread - own * Eigen::Matrix3d::Identity()};
  const std::vector<Eigen::Vector3d> packed = places;
  if ((wanted.centre - points.centre).norm() <= farthest) {
    const Eigen::Matrix3d stretch =
        within(radius, leastStretch(points.spread, target.spread), points.centre, cells, places);
    std::vector<Eigen::Vector3d> moved;
    for (const Eigen::Vector3d& place : places)
      moved.push_back(wanted.centre + stretch * (place - points.centre));
    if (areApart(moved, kApart * radius)) places = std::move(moved);
  }
  if (const double error = errorOf(massOf(cells, places), target); error > kExact) {
    std::vector<Eigen::Vector3d> moved = balancedByRoom(target, cells, radius, packed);
    if (!moved.empty() && errorOf(massOf(cells, moved), target) < error) places = std::move(moved);
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
