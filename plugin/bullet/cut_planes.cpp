#include "bullet/cut_planes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Faces of one plane: difference of their normals, and of their offsets as a share of the diagonal.
constexpr double kSameNormal = 0.01, kSameOffset = 1e-3;
// Planes of the solid's own faces that are tried at each cut: the largest, of this share of the surface.
constexpr std::size_t kFacesTried = 8;
constexpr double kLeastFace = 0.01;
// Faces nearer to a piece's end than this share of the solid's size cut nothing off.
constexpr double kLeastSlice = 0.01;
// Cuts across each axis of a piece, about its centroid, as shares of its extents.
constexpr std::array kShares = {0.0, -0.2, 0.2};

void addAcross(const ConvexPiece& piece, const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre,
               std::vector<CutPlane>& planes) {
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d normal = axes.col(a);
    const auto [low, high] =
        std::ranges::minmax(piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return normal.dot(p); });
    const double extent = normal.dot(high - low);
    for (const double share : kShares) planes.push_back({normal, normal.dot(centre) + share * extent});
  }
}

}  // namespace

std::vector<FacePlane> facePlanesOf(const CutSolid& solid) {
  struct Face {
    std::array<long, 4> key;
    CutPlane plane;
    double area;
  };
  std::vector<FacePlane> planes;
  std::vector<Face> faces;
  const double sameOffset = kSameOffset * solid.diagonal;
  double total = 0;
  for (const CellFace& face : solid.asset.faces) {
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
    if (all.area > kLeastFace * total) planes.push_back(all);
  }
  std::ranges::stable_sort(planes, std::ranges::greater{}, &FacePlane::area);
  return planes;
}

std::vector<FacePlane> planesFor(const CutSolid& solid, std::span<const FacePlane> faces,
                                 const ConvexPiece& piece) {
  std::vector<FacePlane> all;
  const double least = kLeastSlice * std::cbrt(solid.volume);
  for (const FacePlane& face : faces) {
    if (all.size() == kFacesTried) break;
    const auto [low, high] = std::ranges::minmax(
        piece.hull.points, {}, [&](const Eigen::Vector3d& p) { return face.plane.over(p); });
    if (face.plane.over(low) < -least && face.plane.over(high) > least) all.push_back(face);
  }
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : piece.elements)
    centre += solid.asset.volumes[i] / piece.volume * solid.asset.positions[i];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : piece.elements) {
    const Eigen::Vector3d arm = solid.asset.positions[i] - centre;
    spread += solid.asset.volumes[i] * arm * arm.transpose();
  }
  std::vector<CutPlane> across;
  addAcross(piece, Eigen::Matrix3d::Identity(), centre, across);
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  if (axes.cwiseAbs().colwise().maxCoeff().minCoeff() < 0.999) addAcross(piece, axes, centre, across);
  for (const CutPlane& plane : across) all.push_back({plane, 0});
  return all;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
