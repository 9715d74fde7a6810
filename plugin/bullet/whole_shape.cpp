#include "bullet/whole_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>
#include <vector>

#include "bullet/convert.h"
#include "bullet/convex_parts.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// A hull that is larger than the solid by more than this share would be struck where nothing is drawn.
constexpr double kHullExcess = 0.02;
// The same for a box, which has no margin and stacks well.
constexpr double kBoxExcess = 1e-3;
// Bullet keeps hulls apart by their margin, which is seen [m]; and as a share of the thinnest side.
constexpr double kMargin = 1e-3, kMarginShare = 0.02;

// Convex parts are added until they are larger by no more than the first share, or so many. A column is then
// 4, a ring 11 to 16 (3.2 %), the statue of the scenes 16 (3.1 %). What is larger by more than the last stays
// elements.
constexpr double kPartsExcess = 0.03, kMostPartsExcess = 0.1;
constexpr int kMostParts = 16;

std::shared_ptr<btConvexHullShape> hullShape(const ConvexHull& hull, const Eigen::Isometry3d& frame) {
  auto shape = std::make_shared<btConvexHullShape>();
  const Eigen::Isometry3d into = frame.inverse();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : hull.points) {
    box.extend(p);
    shape->addPoint(toBullet(Eigen::Vector3d(into * p)), false);
  }
  shape->setMargin(btScalar(std::min(kMargin, kMarginShare * box.sizes().minCoeff())));
  shape->recalcLocalAabb();
  return shape;
}

// The parts are in the compound's own frame.
void setParts(const std::vector<ConvexHull>& hulls, WholeShape& whole) {
  auto compound = std::make_shared<btCompoundShape>(true, int(hulls.size()));
  for (const ConvexHull& hull : hulls) {
    whole.parts.push_back(hullShape(hull, whole.frame));
    compound->addChildShape(btTransform::getIdentity(), whole.parts.back().get());
  }
  whole.shape = std::move(compound);
}

}  // namespace

SolidHulls solidHullsOf(const Asset& asset) {
  SolidHulls solid;
  const double volume = asset.volume();
  std::vector<Eigen::Vector3d> vertices;
  for (const CellVertex& v : asset.vertices) vertices.push_back(v.position.cast<double>());
  solid.hulls = {convexHullOf(vertices)};
  if (!(solid.hulls[0].volume > 0)) return {};
  solid.isBox = asset.bounds().volume() < (1 + kBoxExcess) * volume;
  if (solid.hulls[0].volume > (1 + kHullExcess) * volume) {
    ConvexParts parts = convexParts(asset, kPartsExcess, kMostParts);
    if (parts.excess > kMostPartsExcess) return {};
    solid.hulls = std::move(parts.hulls);
  }
  return solid;
}

MassFrame massFrameOf(const Asset& asset, std::span<const double> masses, std::span<const double> inertias) {
  MassFrame all;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    all.mass += masses[i];
    all.centre += masses[i] * asset.positions[i];
  }
  all.centre /= all.mass;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const Eigen::Vector3d arm = asset.positions[i] - all.centre;
    all.inertia += (masses[i] * arm.squaredNorm() + inertias[i]) * Eigen::Matrix3d::Identity() -
                   masses[i] * arm * arm.transpose();
  }
  return all;
}

WholeShape wholeShape(const Asset& asset, const SolidHulls& solid, const MassFrame& masses) {
  WholeShape whole;
  whole.mass = masses.mass;
  if (solid.hulls.empty()) return whole;
  if (solid.isBox) {
    const Eigen::AlignedBox3d box = asset.bounds();
    whole.frame.translation() = box.center();
    whole.shape = std::make_shared<btBoxShape>(toBullet(Eigen::Vector3d(0.5 * box.sizes())));
    whole.inertia = toBullet(Eigen::Vector3d(masses.inertia.diagonal()));
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(masses.inertia);
    Eigen::Matrix3d turn = axes.eigenvectors();
    if (turn.determinant() < 0) turn.col(2) = -turn.col(2);
    whole.frame.linear() = turn;
    whole.frame.translation() = masses.centre;
    whole.inertia = toBullet(Eigen::Vector3d(axes.eigenvalues()));
    if (solid.hulls.size() == 1)
      whole.shape = hullShape(solid.hulls[0], whole.frame);
    else
      setParts(solid.hulls, whole);
  }
  whole.elementCentre = whole.frame.inverse() * masses.centre;
  return whole;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
