// How much of a vertex of a cell's faces looks at the sides of a rigid body that it is in.
//
// A vertex of vector area a presses a side of normal n with the weight -a . n. Where another side becomes the
// nearest the weight would jump, and the energy k_n weight depth^2 / 2 with it: a block thrown at the edge of
// a box came back with six times its energy. So n is a mean of the near sides' normals that goes over from
// one to the other, and the weight's slope is a force.
#pragma once

#include "edem/collider.h"

namespace rubble::edem {

/// In the frame of the rigid body.
struct Facing {
  double weight = 0;                                 ///< -a . normal
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< mean of the near sides', length 1 at most
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();   ///< of the weight, as the vertex moves [1/m]
};

/// Of a vertex at `point`, inside a plane, a box or a hull; `area` over the area of weight 1 [-].
Facing facing(const Collider& part, const Eigen::Vector3d& point, const Eigen::Vector3d& area);

}  // namespace rubble::edem
