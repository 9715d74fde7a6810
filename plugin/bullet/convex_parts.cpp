#include "bullet/convex_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bullet/cut_planes.h"
#include "bullet/hull_corners.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Directions by whose furthest points hulls are compared before the best few are looked at in full.
constexpr int kDirections = 48;
constexpr std::size_t kBestFew = 2;
// Each half has this share of the piece's elements, and at least this of a mean cell's volume.
constexpr double kLeastShare = 0.02, kLeastCells = 0.1;
// Two legs below a plate: the first cut there gains nothing, in no place. The face that it takes up counts
// with this share of the mean depth of the solid behind it.
constexpr double kFaceGain = 0.02;
// Nor does the first cut through a ring: one that halves a piece across where it is longest counts with this
// share of its volume.
constexpr double kHalvingGain = 0.03;
// Corners of a part. A ring's parts had 460, which Bullet looks through for each of its contacts; with these
// the hulls of ring and statue are smaller by 1.5 and 0.3 % of the solid, and still larger than it.
constexpr std::size_t kMostCorners = 64;

using Reach = Eigen::Array<float, kDirections, 1>;  // furthest points only: floats do [m]

struct Candidate {
  CutPlane plane;
  double bonus, score;  // [m^3]
};

class Cutter {
 public:
  explicit Cutter(const CutSolid& solid) : m_solid(solid), m_faces(facePlanesOf(solid)) {}

  // The best two pieces of it; false if there are none.
  bool cut(const ConvexPiece& piece, std::array<ConvexPiece, 2>& halves);

 private:
  // By their scores, the best first.
  std::vector<Candidate> candidatesFor(const ConvexPiece& piece);
  std::array<ConvexPiece, 2> halvesOf(const ConvexPiece& piece, const CutPlane& plane) const;
  double estimate(const ConvexPiece& piece, const CutPlane& plane);
  double sideVolume(const ConvexPiece& piece, std::uint8_t side, std::span<const Eigen::Vector3d> corners);

  const CutSolid& m_solid;
  const Eigen::Matrix3Xf m_directions = directionsAround(kDirections).cast<float>();
  std::vector<FacePlane> m_faces;                             // the solid's own, the largest first
  Crossings m_crossings;                                      // scratch
  Eigen::Matrix<float, kDirections, Eigen::Dynamic> m_reach;  // of the piece's points
  std::vector<Eigen::Vector3d> m_points;
};

double extentAlong(const ConvexPiece& piece, const Eigen::Vector3d& normal) {
  const auto [low, high] =
      std::ranges::minmax(piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return normal.dot(p); });
  return normal.dot(high - low);
}

// Of the furthest points of one side.
double Cutter::sideVolume(const ConvexPiece& piece, std::uint8_t side,
                          std::span<const Eigen::Vector3d> corners) {
  std::array<float, kDirections> furthest;
  furthest.fill(-std::numeric_limits<float>::infinity());
  std::array<std::int32_t, kDirections> at;  // those of the surface, then the corners
  at.fill(-1);
  const auto take = [&](std::int32_t point, const float* reach) {
    for (std::size_t d = 0; d < kDirections; ++d) {
      const bool isFurther = reach[d] > furthest[d];
      furthest[d] = isFurther ? reach[d] : furthest[d];
      at[d] = isFurther ? point : at[d];
    }
  };
  const std::size_t own = piece.surface.points.size();
  for (std::size_t i = 0; i < own; ++i) {
    const std::uint8_t sides = m_crossings.sides[i];
    if (!(sides & side) || (piece.surface.uses[i] != PointUse::Corner && sides == side)) continue;
    take(std::int32_t(i), m_reach.col(Eigen::Index(i)).data());
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Reach reach = m_directions.transpose() * corners[i].cast<float>();
    take(std::int32_t(own + i), reach.data());
  }
  std::ranges::sort(at);
  const auto repeated = std::ranges::unique(at);
  m_points.clear();
  for (auto p = at.begin(); p != repeated.begin(); ++p)
    if (*p >= 0)
      m_points.push_back(std::size_t(*p) < own ? piece.surface.points[std::size_t(*p)]
                                               : corners[std::size_t(*p) - own]);
  return convexHullOf(m_points).volume;
}

double Cutter::estimate(const ConvexPiece& piece, const CutPlane& plane) {
  findCrossings(piece.surface, plane, m_solid.nearness, m_crossings);
  addInnerCorners(m_solid, piece.borders, plane, m_crossings.between);
  double sum = 0;
  for (const std::uint8_t side : {Crossings::kBelow, Crossings::kAbove})
    sum += sideVolume(piece, side, m_crossings.between);
  return sum;
}

std::vector<Candidate> Cutter::candidatesFor(const ConvexPiece& piece) {
  const auto count = Eigen::Index(piece.surface.points.size());
  m_reach.noalias() =
      m_directions.transpose() *
      Eigen::Map<const Eigen::Matrix3Xd>(piece.surface.points[0].data(), 3, count).cast<float>();
  std::vector<Candidate> candidates;
  const double depth = std::cbrt(m_solid.volume);
  double longest = 0;
  for (int d = 0; d < kDirections; ++d)
    longest = std::max(longest, extentAlong(piece, m_directions.col(d).cast<double>()));
  for (const FacePlane& tried : planesFor(m_solid, m_faces, piece)) {
    const auto above = std::ranges::count_if(
        piece.elements, [&](std::uint32_t i) { return tried.plane.over(m_solid.asset.positions[i]) > 0; });
    const double share = double(above) / double(piece.elements.size()), smaller = std::min(share, 1 - share);
    if (above == 0 || smaller < kLeastShare) continue;
    const double halving = 2 * smaller * extentAlong(piece, tried.plane.normal) / longest;
    const double bonus = kFaceGain * depth * tried.area + kHalvingGain * piece.volume * halving;
    candidates.push_back({tried.plane, bonus, estimate(piece, tried.plane) - bonus});
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::score);
  return candidates;
}

std::array<ConvexPiece, 2> Cutter::halvesOf(const ConvexPiece& piece, const CutPlane& plane) const {
  std::array<CutSurface, 2> surfaces = cutSurface(piece.surface, plane, m_solid.nearness);
  std::array<ConvexPiece, 2> halves;
  for (std::size_t side = 0; side < 2; ++side) {
    halves[side].surface = std::move(surfaces[side]);
    halves[side].borders = piece.borders;
    halves[side].borders.push_back(side == 0 ? plane : CutPlane{-plane.normal, -plane.offset});
  }
  for (const std::uint32_t i : piece.elements)
    halves[plane.over(m_solid.asset.positions[i]) > 0].elements.push_back(i);
  for (ConvexPiece& half : halves) setHull(m_solid, half);
  return halves;
}

bool Cutter::cut(const ConvexPiece& piece, std::array<ConvexPiece, 2>& halves) {
  const std::vector<Candidate> candidates = candidatesFor(piece);
  double best = std::numeric_limits<double>::infinity();
  const double least = kLeastCells * m_solid.volume / double(m_solid.asset.elementCount());
  for (std::size_t c = 0; c < std::min(kBestFew, candidates.size()); ++c) {
    std::array<ConvexPiece, 2> tried = halvesOf(piece, candidates[c].plane);
    const double score = tried[0].hull.volume + tried[1].hull.volume - candidates[c].bonus;
    if (tried[0].elements.empty() || tried[1].elements.empty()) continue;
    if (!(std::min(tried[0].hull.volume, tried[1].hull.volume) > least) || !(score < best)) continue;
    best = score;
    halves = std::move(tried);
  }
  return std::isfinite(best);
}

}  // namespace

ConvexParts convexParts(const Asset& asset, double enough, int most) {
  const CutSolid solid(asset);
  Cutter cutter(solid);
  std::vector<ConvexPiece> pieces;
  pieces.push_back(wholePiece(solid));
  double sum = pieces[0].hull.volume;
  while (int(pieces.size()) < most && sum > (1 + enough) * solid.volume) {
    const auto worst = std::ranges::max_element(pieces, {}, [](const ConvexPiece& p) {
      return p.done ? -std::numeric_limits<double>::infinity() : p.excess();
    });
    if (worst->done || !(worst->excess() > 0)) break;
    std::array<ConvexPiece, 2> halves;
    if (!cutter.cut(*worst, halves)) {
      worst->done = true;
      continue;
    }
    sum += halves[0].hull.volume + halves[1].hull.volume - worst->hull.volume;
    *worst = std::move(halves[0]);
    pieces.push_back(std::move(halves[1]));
  }
  ConvexParts parts;
  sum = 0;
  for (const ConvexPiece& piece : pieces) {
    parts.hulls.push_back(hullOfFew(outlineOf(solid, piece), kMostCorners));
    sum += parts.hulls.back().volume;
  }
  parts.excess = sum / solid.volume - 1;
  return parts;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
