#include "bullet/whole_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// A hull that is larger than the solid by more than this share would be struck where nothing is drawn.
constexpr double kHullExcess = 0.02;
// The same for a box, which has no margin and stacks well.
constexpr double kBoxExcess = 1e-3;
// Bullet keeps hulls apart by their margin, which is seen [m]; and as a share of the thinnest side.
constexpr double kMargin = 1e-3, kMarginShare = 0.02;

struct Hull {
  std::vector<Eigen::Vector3d> points;
  double volume = 0;
};

Hull hullOf(const std::vector<CellVertex>& vertices) {
  std::vector<btVector3> input;
  for (const CellVertex& v : vertices) input.push_back(toBullet(Eigen::Vector3d(v.position.cast<double>())));
  Hull hull;
  btConvexHullComputer computer;
  computer.compute(&input[0][0], int(sizeof(btVector3)), int(input.size()), 0, 0);
  for (int i = 0; i < computer.vertices.size(); ++i) hull.points.push_back(toEigen(computer.vertices[i]));
  if (hull.points.empty()) return hull;
  const Eigen::Vector3d apex = hull.points[0];
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    const Eigen::Vector3d corner = hull.points[std::size_t(first->getSourceVertex())] - apex;
    for (const auto* e = first->getNextEdgeOfFace(); e->getNextEdgeOfFace() != first;
         e = e->getNextEdgeOfFace()) {
      const Eigen::Vector3d a = hull.points[std::size_t(e->getSourceVertex())] - apex,
                            b = hull.points[std::size_t(e->getTargetVertex())] - apex;
      hull.volume += std::abs(corner.dot(a.cross(b))) / 6;  // seen from a corner all faces turn one way
    }
  }
  return hull;
}

Eigen::Matrix3d inertiaOf(const Asset& asset, std::span<const double> masses,
                          std::span<const double> inertias, const Eigen::Vector3d& centre) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const Eigen::Vector3d arm = asset.positions[i] - centre;
    sum += (masses[i] * arm.squaredNorm() + inertias[i]) * Eigen::Matrix3d::Identity() -
           masses[i] * arm * arm.transpose();
  }
  return sum;
}

}  // namespace

WholeShape wholeShape(const Asset& asset, std::span<const double> masses, std::span<const double> inertias) {
  WholeShape whole;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double volume = 0;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    whole.mass += masses[i];
    centre += masses[i] * asset.positions[i];
    volume += asset.volumes[i];
  }
  centre /= whole.mass;
  const Hull hull = hullOf(asset.vertices);
  if (!(hull.volume > 0) || hull.volume > (1 + kHullExcess) * volume) return whole;

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : hull.points) box.extend(p);
  const Eigen::Matrix3d inertia = inertiaOf(asset, masses, inertias, centre);
  if (box.volume() < (1 + kBoxExcess) * volume) {
    whole.frame.translation() = box.center();
    whole.shape = std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d(0.5 * box.sizes())));
    whole.inertia = toBullet(Eigen::Vector3d(inertia.diagonal()));
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
    Eigen::Matrix3d turn = axes.eigenvectors();
    if (turn.determinant() < 0) turn.col(2) = -turn.col(2);
    whole.frame.linear() = turn;
    whole.frame.translation() = centre;
    whole.inertia = toBullet(Eigen::Vector3d(axes.eigenvalues()));
    auto shape = std::make_unique<btConvexHullShape>();
    for (const Eigen::Vector3d& p : hull.points)
      shape->addPoint(toBullet(Eigen::Vector3d(whole.frame.inverse() * p)), false);
    shape->setMargin(btScalar(std::min(kMargin, kMarginShare * box.sizes().minCoeff())));
    shape->recalcLocalAabb();
    whole.shape = std::move(shape);
  }
  whole.elementCentre = whole.frame.inverse() * centre;
  return whole;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
