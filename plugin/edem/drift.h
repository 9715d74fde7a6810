// What things have in common in their motion while nothing that stands can meet them: it calls for no shorter
// substeps and no new lists, however fast they fall.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "edem/body.h"
#include "edem/rigid_proxy.h"

namespace rubble::edem {

struct Drift {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();     ///< by it since it was found [m]
};

struct Drifts {
  std::vector<Drift> bodies, proxies;

  void advance(double step);
  bool any() const;
};

/// Things whose ways may cross in the next `left` seconds drift with the velocity of their centre of mass,
/// and not at all with something that stands or that the application moves. Holds until one of their points
/// has moved `skin` / 2 beside the drift; must be found together with new lists.
template <class Real>
void findDrifts(std::span<const std::unique_ptr<Body<Real>>> bodies, std::span<const RigidProxy> proxies,
                double skin, double left, Drifts& drifts);

}  // namespace rubble::edem
