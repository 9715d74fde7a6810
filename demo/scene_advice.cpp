#include "demo/scene_advice.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/number_text.h"

namespace rubble::demo {
namespace {

using base::numberText;

std::string text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  const char* before = "[";
  for (const double x : v) {
    out << before << numberText(std::round(x * 1000) / 1000);  // to millimetres
    before = ", ";
  }
  return out.str() + "]";
}

// Of the object where it stands; `rest` are those in its own frame.
Eigen::AlignedBox3d boundsOf(const SceneObject& object, const Eigen::AlignedBox3d& rest) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (const double degrees = object.rotationDegrees.norm(); degrees > 0)
    turn = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, object.rotationDegrees / degrees);
  const Eigen::Vector3d half = turn.cwiseAbs() * rest.sizes() / 2;
  const Eigen::Vector3d centre = object.position + turn * rest.center();
  return {centre - half, centre + half};
}

void adviseOnObject(const Scene& scene, std::size_t index, const Eigen::AlignedBox3d& rest,
                    const Eigen::Vector3d& cell, const LogFunction& log) {
  const Eigen::AlignedBox3d object = boundsOf(scene.objects[index], rest);
  const Eigen::AlignedBox3d box(scene.dust->min, scene.dust->max);
  // Half a cell is not seen.
  const Eigen::AlignedBox3d roomy(box.min() - cell / 2, box.max() + cell / 2);
  if (roomy.contains(object)) return;
  const std::string where = box.intersects(object) ? "reaches out of" : "is outside of";
  const std::string name = "objects." + std::to_string(index);
  log(LogLevel::Warning, scene.blamed(name, {"dust"}) + ": " + name + ": " + text(object.min()) + " to " +
                             text(object.max()) + " m " + where + " the dust's box, " + text(box.min()) +
                             " to " + text(box.max()) +
                             " m: dust from there is lost at once; change dust.min and dust.max, or move the "
                             "object");
}

void adviseOnFloor(const Scene& scene, const Eigen::Vector3d& cell, const LogFunction& log) {
  for (const SceneBody& body : scene.statics) {
    const bool level = body.shape == SceneBody::Shape::Plane && body.normal.normalized().y() > 1 - 1e-9 &&
                       body.rotationDegrees.norm() == 0;
    if (!level) continue;
    const double height = body.position.y() + body.offset;
    if (std::abs(height - scene.dust->min.y()) <= cell.y() / 2) return;
    log(LogLevel::Warning, scene.blamed("dust.min", {"statics"}) + ": dust.min: its y is " +
                               numberText(scene.dust->min.y()) +
                               " m and is ground to the dust, but the ground is at " + numberText(height) +
                               " m: dust will lie at the wrong height");
    return;
  }
}

}  // namespace

void adviseOnDust(const Scene& scene, std::span<const Eigen::AlignedBox3d> bounds, const LogFunction& log) {
  if (!scene.dust || !log) return;
  const Eigen::Vector3d cell = (scene.dust->max - scene.dust->min) / scene.dust->resolution;
  for (std::size_t i = 0; i < bounds.size(); ++i) adviseOnObject(scene, i, bounds[i], cell, log);
  adviseOnFloor(scene, cell, log);
}

}  // namespace rubble::demo
