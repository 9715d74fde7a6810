// Cells and elements to crush.
#pragma once

#include <cmath>
#include <vector>

#include "debris/spawn.h"
#include "unit/debris/random.h"

namespace rubble::test {

struct TestCell {
  std::vector<CellFace> faces;
  base::CrushedElement element;  ///< geometry, mass and inertia only
};

/// A cube of the given edge [m] about `centre`; its element fits inside.
inline TestCell cubeCell(double edge, double density,
                         const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  TestCell cell;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d normal = side * Eigen::Vector3d::Unit(axis);
      cell.faces.push_back({kNoElement, float(edge * edge), normal.cast<float>(),
                            Eigen::Vector3d(centre + 0.5 * edge * normal).cast<float>()});
    }
  }
  cell.element.restCentre = centre;
  cell.element.volume = edge * edge * edge;
  cell.element.mass = density * cell.element.volume;
  cell.element.inertia = cell.element.mass * edge * edge / 6;
  cell.element.radius = 0.5 * edge;
  cell.element.maxRadius = 0.25 * edge;
  return cell;
}

/// A cell of `count` faces at random: not even closed, as lopsided as it comes.
inline TestCell randomCell(Random& random, int count) {
  TestCell cell;
  base::CrushedElement& e = cell.element;
  e.radius = random.uniform(0.005, 0.05);
  e.restCentre = random.inBall(2);
  for (int n = 0; n < count; ++n) {
    const Eigen::Vector3d normal = random.direction();
    const Eigen::Vector3d centroid =
        e.restCentre + random.uniform(0.6, 1.6) * e.radius * normal + random.inBall(0.5 * e.radius);
    cell.faces.push_back({kNoElement, 1e-4f, normal.cast<float>(), centroid.cast<float>()});
  }
  e.volume = random.uniform(4, 8) * e.radius * e.radius * e.radius;
  e.mass = 2400 * e.volume;
  e.inertia = random.uniform(0.2, 0.6) * e.mass * e.radius * e.radius;
  e.maxRadius = e.radius * random.uniform(0.001, 1);
  return cell;
}

/// Puts an element into some place and motion.
inline void setInMotion(Random& random, base::CrushedElement& element) {
  element.centre = random.inBall(1);
  element.orientation = random.rotation();
  element.velocity = random.inBall(20);
  element.spin = random.inBall(100);
  element.releasedEnergy = random.uniform(0, 1) * element.mass;
  element.element = std::uint32_t(random.uniform(0, 1e6));
}

}  // namespace rubble::test
