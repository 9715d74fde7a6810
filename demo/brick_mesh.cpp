#include "demo/brick_mesh.h"

#include <algorithm>
#include <sstream>

namespace rubble::demo {
namespace {

constexpr double kShortest = 0.1;  // of what is left of a brick that is cut [brick]

double pitchOf(const BrickCourse& course) {
  return course.brick.x() + course.joint;
}

void addBrick(double low, double high, const Eigen::Vector3d& brick, SurfaceMesh& mesh) {
  const SurfaceMesh box = boxMesh({high - low, brick.y(), brick.z()});
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : box.vertices)
    mesh.vertices.push_back(vertex + (low + high) / 2 * Eigen::Vector3d::UnitX());
  for (const auto& [a, b, c] : box.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

std::string wrongOffset(const BrickCourse& course) {
  if (!(course.offset > 0)) return "";
  const double pitch = pitchOf(course), shortest = kShortest * course.brick.x();
  const double least = (course.joint + shortest) / pitch, most = (course.brick.x() - shortest) / pitch;
  if (course.offset >= least && course.offset <= most) return "";
  if (least > most) return "must be 0 where the joints are so wide";
  std::ostringstream text;
  text << "must be 0, or " << least << " to " << most << ", so that a tenth of a brick is left at both ends";
  return text.str();
}

SurfaceMesh brickCourseMesh(const BrickCourse& course) {
  const double pitch = pitchOf(course);
  const double half = (course.bricks * pitch - course.joint) / 2;
  const std::uint32_t last = course.offset > 0 ? course.bricks + 1 : course.bricks;
  SurfaceMesh mesh;
  for (std::uint32_t k = 0; k < last; ++k) {
    const double low = (k + course.offset - (course.offset > 0)) * pitch - half;
    addBrick(std::max(low, -half), std::min(low + course.brick.x(), half), course.brick, mesh);
  }
  return mesh;
}

}  // namespace rubble::demo
