#include "bullet/convex_parts.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bullet/convex_cut.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Cell vertices are floats: what is nearer to a plane than this share of the diagonal is on it.
constexpr double kNearness = 1e-6;
// A place may be beyond a cell's faces by this share of the radius.
constexpr double kInside = 1e-3;
// Faces of one plane: difference of their normals, and of their offsets as a share of the diagonal.
constexpr double kSameNormal = 0.01, kSameOffset = 1e-3;
// Planes of the solid's own faces that are tried at each cut: the largest, of this share of the surface.
constexpr std::size_t kFacesTried = 8;
constexpr double kLeastFace = 0.01;
// Cuts across each axis of a piece, about its centroid, as shares of its extents.
constexpr std::array kShares = {0.0, -0.2, 0.2};
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

using Directions = Eigen::Matrix<double, 3, kDirections>;

// A spiral over the sphere [SaffKuijlaars97]: along no axis of a solid.
Directions spiral() {
  Directions all;
  for (int d = 0; d < kDirections; ++d) {
    const double z = 1 - (2 * d + 1) / double(kDirections), angle = d * std::numbers::pi * (3 - std::sqrt(5));
    const double r = std::sqrt(1 - z * z);
    all.col(d) = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
  }
  return all;
}

struct FacePlane {
  CutPlane plane;
  double area = 0;  // [m^2]
};

struct Piece {
  CutSurface surface;
  std::vector<CutPlane> borders;  // it is below all of them
  std::vector<std::uint32_t> elements;
  double volume = 0;  // of these [m^3]
  ConvexHull hull;
  bool done = false;  // no cut helps
  double excess() const { return hull.volume - volume; }
};

class Cutter {
 public:
  explicit Cutter(const Asset& asset)
      : m_asset(asset),
        m_diagonal(asset.diagonal()),
        m_nearness(kNearness * m_diagonal),
        m_volume(asset.volume()) {
    gatherFaces();
  }

  Piece whole() const {
    Piece piece;
    piece.surface = outerSurface(m_asset);
    for (std::size_t i = 0; i < m_asset.elementCount(); ++i) piece.elements.push_back(std::uint32_t(i));
    setHull(piece, false);
    return piece;
  }

  // The best two pieces of it; false if there are none.
  bool cut(const Piece& piece, std::array<Piece, 2>& halves);

  // Of all its points; else of those that matter for its volume.
  void setHull(Piece& piece, bool exact) const;

 private:
  struct Candidate {
    CutPlane plane;
    double bonus, score;  // [m^3]
  };

  void gatherFaces();
  void addAcross(const Piece& piece, const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre,
                 std::vector<CutPlane>& planes) const;
  std::vector<FacePlane> planesFor(const Piece& piece) const;
  double estimate(const Piece& piece, const CutPlane& plane);
  double sideVolume(const Piece& piece, std::uint8_t side, std::span<const Eigen::Vector3d> corners);
  bool isInside(const Eigen::Vector3d& x) const;
  void addCorners(const Piece& piece, const CutPlane& plane, std::vector<Eigen::Vector3d>& corners) const;

  const Asset& m_asset;
  double m_diagonal, m_nearness, m_volume;
  const Directions m_directions = spiral();
  std::vector<FacePlane> m_faces;                              // the solid's own, the largest first
  Crossings m_crossings;                                       // scratch
  Eigen::Matrix<double, kDirections, Eigen::Dynamic> m_reach;  // of the piece's points
  std::vector<Eigen::Vector3d> m_points;
};

void Cutter::gatherFaces() {
  struct Face {
    std::array<long, 4> key;
    CutPlane plane;
    double area;
  };
  std::vector<Face> faces;
  const double sameOffset = kSameOffset * m_diagonal;
  double total = 0;
  for (const CellFace& face : m_asset.faces) {
    if (face.neighbour != kNoElement) continue;
    const Eigen::Vector3d normal = face.normal.cast<double>();
    const double offset = normal.dot(face.centroid.cast<double>());
    const auto rounded = [](double x, double unit) { return std::lround(x / unit); };
    faces.push_back({{rounded(normal.x(), kSameNormal), rounded(normal.y(), kSameNormal),
                      rounded(normal.z(), kSameNormal), rounded(offset, sameOffset)},
                     {normal, offset},
                     double(face.area)});
    total += double(face.area);
  }
  std::ranges::stable_sort(faces, {}, &Face::key);
  for (std::size_t i = 0; i < faces.size();) {
    FacePlane all{faces[i].plane, 0};
    const std::array<long, 4> key = faces[i].key;
    for (; i < faces.size() && faces[i].key == key; ++i) all.area += faces[i].area;
    if (all.area > kLeastFace * total) m_faces.push_back(all);
  }
  std::ranges::stable_sort(m_faces, std::ranges::greater{}, &FacePlane::area);
}

// By the cell of the nearest element; the cell of a notch may say no.
bool Cutter::isInside(const Eigen::Vector3d& x) const {
  const auto nearest = std::ranges::min_element(
      m_asset.positions, {}, [&](const Eigen::Vector3d& p) { return (p - x).squaredNorm(); });
  return std::ranges::all_of(
      m_asset.cellFaces(std::size_t(nearest - m_asset.positions.begin())), [&](const CellFace& face) {
        return face.normal.cast<double>().dot(x - face.centroid.cast<double>()) < kInside * m_asset.radius;
      });
}

// Corners of the piece where three planes meet within the solid: no triangle of the surface has them.
void Cutter::addCorners(const Piece& piece, const CutPlane& plane,
                        std::vector<Eigen::Vector3d>& corners) const {
  for (std::size_t a = 0; a < piece.borders.size(); ++a) {
    for (std::size_t b = a + 1; b < piece.borders.size(); ++b) {
      Eigen::Matrix3d normals;
      normals << plane.normal.transpose(), piece.borders[a].normal.transpose(),
          piece.borders[b].normal.transpose();
      if (std::abs(normals.determinant()) < 1e-3) continue;
      const Eigen::Vector3d x =
          normals.inverse() * Eigen::Vector3d(plane.offset, piece.borders[a].offset, piece.borders[b].offset);
      const bool isOfPiece =
          std::ranges::all_of(piece.borders, [&](const CutPlane& p) { return p.over(x) < m_nearness; });
      if (isOfPiece && isInside(x)) corners.push_back(x);
    }
  }
}

void Cutter::setHull(Piece& piece, bool exact) const {
  piece.volume = 0;
  for (const std::uint32_t i : piece.elements) piece.volume += m_asset.volumes[i];
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < piece.surface.points.size(); ++i)
    if (piece.surface.uses[i] == PointUse::Corner || (exact && piece.surface.uses[i] != PointUse::Flat))
      points.push_back(piece.surface.points[i]);
  if (!piece.elements.empty()) {
    Piece before{{}, {}, piece.elements, 0, {}, false};
    for (const CutPlane& border : piece.borders) {
      addCorners(before, border, points);
      before.borders.push_back(border);
    }
    // Those that a later border has cut off.
    std::erase_if(points, [&](const Eigen::Vector3d& x) {
      return std::ranges::any_of(piece.borders,
                                 [&](const CutPlane& p) { return p.over(x) > 2 * m_nearness; });
    });
  }
  piece.hull = convexHullOf(points);
}

double extentAlong(const Piece& piece, const Eigen::Vector3d& normal) {
  const auto [low, high] =
      std::ranges::minmax(piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return normal.dot(p); });
  return normal.dot(high - low);
}

void Cutter::addAcross(const Piece& piece, const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre,
                       std::vector<CutPlane>& planes) const {
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d normal = axes.col(a);
    const auto [low, high] =
        std::ranges::minmax(piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return normal.dot(p); });
    const double extent = normal.dot(high - low);
    for (const double share : kShares) planes.push_back({normal, normal.dot(centre) + share * extent});
  }
}

std::vector<FacePlane> Cutter::planesFor(const Piece& piece) const {
  std::vector<FacePlane> all;
  const double least = 0.01 * std::cbrt(m_volume);
  for (const FacePlane& face : m_faces) {
    if (all.size() == kFacesTried) break;
    const auto [low, high] = std::ranges::minmax(
        piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return face.plane.over(p); });
    if (face.plane.over(low) < -least && face.plane.over(high) > least) all.push_back(face);
  }
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : piece.elements)
    centre += m_asset.volumes[i] / piece.volume * m_asset.positions[i];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : piece.elements) {
    const Eigen::Vector3d arm = m_asset.positions[i] - centre;
    spread += m_asset.volumes[i] * arm * arm.transpose();
  }
  std::vector<CutPlane> across;
  addAcross(piece, Eigen::Matrix3d::Identity(), centre, across);
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  if (axes.cwiseAbs().colwise().maxCoeff().minCoeff() < 0.999) addAcross(piece, axes, centre, across);
  for (const CutPlane& plane : across) all.push_back({plane, 0});
  return all;
}

// Of the furthest points of one side.
double Cutter::sideVolume(const Piece& piece, std::uint8_t side, std::span<const Eigen::Vector3d> corners) {
  Eigen::Array<double, kDirections, 1> furthest;
  furthest.setConstant(-std::numeric_limits<double>::infinity());
  std::array<const Eigen::Vector3d*, kDirections> at{};
  const auto take = [&](const Eigen::Vector3d& point, const auto& reach) {
    for (int d = 0; d < kDirections; ++d) {
      if (!(reach[d] > furthest[d])) continue;
      furthest[d] = reach[d];
      at[std::size_t(d)] = &point;
    }
  };
  for (std::size_t i = 0; i < piece.surface.points.size(); ++i) {
    const std::uint8_t sides = m_crossings.sides[i];
    if (!(sides & side) || (piece.surface.uses[i] != PointUse::Corner && sides == side)) continue;
    take(piece.surface.points[i], m_reach.col(Eigen::Index(i)));
  }
  for (const Eigen::Vector3d& corner : corners) take(corner, (m_directions.transpose() * corner).eval());
  std::ranges::sort(at);
  const auto repeated = std::ranges::unique(at);
  m_points.clear();
  for (auto p = at.begin(); p != repeated.begin(); ++p)
    if (*p) m_points.push_back(**p);
  return convexHullOf(m_points).volume;
}

double Cutter::estimate(const Piece& piece, const CutPlane& plane) {
  findCrossings(piece.surface, plane, m_nearness, m_crossings);
  addCorners(piece, plane, m_crossings.between);
  double sum = 0;
  for (const std::uint8_t side : {Crossings::kBelow, Crossings::kAbove})
    sum += sideVolume(piece, side, m_crossings.between);
  return sum;
}

bool Cutter::cut(const Piece& piece, std::array<Piece, 2>& halves) {
  const auto count = Eigen::Index(piece.surface.points.size());
  m_reach.noalias() =
      m_directions.transpose() * Eigen::Map<const Eigen::Matrix3Xd>(piece.surface.points[0].data(), 3, count);
  std::vector<Candidate> candidates;
  const double depth = std::cbrt(m_volume);
  double longest = 0;
  for (int d = 0; d < kDirections; ++d) longest = std::max(longest, extentAlong(piece, m_directions.col(d)));
  for (const FacePlane& tried : planesFor(piece)) {
    const auto above = std::ranges::count_if(
        piece.elements, [&](std::uint32_t i) { return tried.plane.over(m_asset.positions[i]) > 0; });
    const double share = double(above) / double(piece.elements.size()), smaller = std::min(share, 1 - share);
    if (above == 0 || smaller < kLeastShare) continue;
    const double halving = 2 * smaller * extentAlong(piece, tried.plane.normal) / longest;
    const double bonus = kFaceGain * depth * tried.area + kHalvingGain * piece.volume * halving;
    candidates.push_back({tried.plane, bonus, estimate(piece, tried.plane) - bonus});
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::score);
  double best = std::numeric_limits<double>::infinity();
  const double least = kLeastCells * m_volume / double(m_asset.elementCount());
  for (std::size_t c = 0; c < std::min(kBestFew, candidates.size()); ++c) {
    const CutPlane& plane = candidates[c].plane;
    std::array<CutSurface, 2> surfaces = cutSurface(piece.surface, plane, m_nearness);
    std::array<Piece, 2> tried;
    for (std::size_t side = 0; side < 2; ++side) {
      tried[side].surface = std::move(surfaces[side]);
      tried[side].borders = piece.borders;
      tried[side].borders.push_back(side == 0 ? plane : CutPlane{-plane.normal, -plane.offset});
    }
    for (const std::uint32_t i : piece.elements)
      tried[plane.over(m_asset.positions[i]) > 0].elements.push_back(i);
    for (Piece& half : tried) setHull(half, false);
    const double sum = tried[0].hull.volume + tried[1].hull.volume;
    const double score = sum - candidates[c].bonus;
    if (tried[0].elements.empty() || tried[1].elements.empty()) continue;
    if (!(std::min(tried[0].hull.volume, tried[1].hull.volume) > least) || !(score < best)) continue;
    best = score;
    halves = std::move(tried);
  }
  return std::isfinite(best);
}

}  // namespace

ConvexParts convexParts(const Asset& asset, double enough, int most) {
  Cutter cutter(asset);
  std::vector<Piece> pieces;
  pieces.push_back(cutter.whole());
  const double volume = asset.volume();
  double sum = pieces[0].hull.volume;
  while (int(pieces.size()) < most && sum > (1 + enough) * volume) {
    const auto worst = std::ranges::max_element(pieces, {}, [](const Piece& p) {
      return p.done ? -std::numeric_limits<double>::infinity() : p.excess();
    });
    if (worst->done || !(worst->excess() > 0)) break;
    std::array<Piece, 2> halves;
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
  for (Piece& piece : pieces) {
    cutter.setHull(piece, true);
    sum += piece.hull.volume;
    parts.hulls.push_back(std::move(piece.hull));
  }
  parts.excess = sum / volume - 1;
  return parts;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
