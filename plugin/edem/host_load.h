// What the host presses an element with, all through one tick.
#pragma once

#include "edem/types.h"

namespace rubble::edem {

struct HostLoad {
  std::uint32_t element = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about its centre [N m]
};

}  // namespace rubble::edem
