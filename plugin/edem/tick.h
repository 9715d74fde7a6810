// A tick of all bodies, from the host's rigid bodies to the report.
#pragma once

#include <span>

#include "edem/rigid_proxy.h"
#include "edem/world.h"

namespace rubble::edem {

/// Advances the world by `dt` [s] in as many substeps as are stable. The host applies the proxies' impulses
/// and handles the crushed afterwards. A tick that cannot be run leaves world.failure.
template <class Real>
void tick(World<Real>& world, double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies);

}  // namespace rubble::edem
