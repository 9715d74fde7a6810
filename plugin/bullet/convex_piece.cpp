#include "bullet/convex_piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Cell vertices are floats, 6e-8 of their place: what is nearer to a plane than this share of the diagonal is
// on it.
constexpr double kNearness = 1e-6;
// A place may be beyond a cell's faces by this share of the radius: corners where three cuts meet on a face
// of the solid are within its floats of that.
constexpr double kInside = 1e-3;
// Three planes meet in a corner where the volume that their normals span is more.
constexpr double kLeastSpan = 1e-3;

// By the cell of the nearest element; the cell of a notch may say no.
bool isInside(const Asset& asset, const Eigen::Vector3d& x) {
  const auto nearest = std::ranges::min_element(
      asset.positions, {}, [&](const Eigen::Vector3d& p) { return (p - x).squaredNorm(); });
  return std::ranges::all_of(
      asset.cellFaces(std::size_t(nearest - asset.positions.begin())), [&](const CellFace& face) {
        return face.normal.cast<double>().dot(x - face.centroid.cast<double>()) < kInside * asset.radius;
      });
}

// Where the borders meet one another.
void addBorderCorners(const CutSolid& solid, const ConvexPiece& piece, std::vector<Eigen::Vector3d>& points) {
  std::vector<CutPlane> before;
  const std::size_t first = points.size();
  for (const CutPlane& border : piece.borders) {
    addInnerCorners(solid, before, border, points);
    before.push_back(border);
  }
  // Those that a later border has cut off.
  const auto isCutOff = [&](const Eigen::Vector3d& x) {
    return std::ranges::any_of(piece.borders,
                               [&](const CutPlane& p) { return p.over(x) > 2 * solid.nearness; });
  };
  points.erase(std::remove_if(points.begin() + std::ptrdiff_t(first), points.end(), isCutOff), points.end());
}

template <class IsTaken>
std::vector<Eigen::Vector3d> pointsOf(const CutSolid& solid, const ConvexPiece& piece, IsTaken&& isTaken) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < piece.surface.points.size(); ++i)
    if (isTaken(piece.surface.uses[i])) points.push_back(piece.surface.points[i]);
  if (!piece.elements.empty()) addBorderCorners(solid, piece, points);
  return points;
}

}  // namespace

CutSolid::CutSolid(const Asset& of)
    : asset(of), diagonal(of.diagonal()), nearness(kNearness * diagonal), volume(of.volume()) {}

ConvexPiece wholePiece(const CutSolid& solid) {
  ConvexPiece piece;
  piece.surface = outerSurface(solid.asset);
  for (std::size_t i = 0; i < solid.asset.elementCount(); ++i) piece.elements.push_back(std::uint32_t(i));
  setHull(solid, piece);
  return piece;
}

void setHull(const CutSolid& solid, ConvexPiece& piece) {
  piece.volume = 0;
  for (const std::uint32_t i : piece.elements) piece.volume += solid.asset.volumes[i];
  piece.hull = convexHullOf(pointsOf(solid, piece, [](PointUse use) { return use == PointUse::Corner; }));
}

std::vector<Eigen::Vector3d> outlineOf(const CutSolid& solid, const ConvexPiece& piece) {
  return pointsOf(solid, piece, [](PointUse use) { return use != PointUse::Flat; });
}

void addInnerCorners(const CutSolid& solid, const std::vector<CutPlane>& borders, const CutPlane& plane,
                     std::vector<Eigen::Vector3d>& corners) {
  for (std::size_t a = 0; a < borders.size(); ++a) {
    for (std::size_t b = a + 1; b < borders.size(); ++b) {
      Eigen::Matrix3d normals;
      normals << plane.normal.transpose(), borders[a].normal.transpose(), borders[b].normal.transpose();
      if (std::abs(normals.determinant()) < kLeastSpan) continue;
      const Eigen::Vector3d x =
          normals.inverse() * Eigen::Vector3d(plane.offset, borders[a].offset, borders[b].offset);
      const bool isOfPiece =
          std::ranges::all_of(borders, [&](const CutPlane& p) { return p.over(x) < solid.nearness; });
      if (isOfPiece && isInside(solid.asset, x)) corners.push_back(x);
    }
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
