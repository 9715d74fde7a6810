// The surfaces that debris hit in one step, with the motion that the hits so far have left them: each hit
// meets a surface as the hit before it left it. Hits that all met the motion of the step's start would
// together make energy: 60 pieces of 6 g at 10 m/s would throw an element of 90 g at 50 m/s.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "debris/debris_collider.h"
#include "debris/motion.h"

namespace rubble::debris {

/// What a surface received from the debris in one step, about the world's origin.
struct SurfaceImpulse {
  std::uint32_t surface = kFixedSurface;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [N s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< [N m s]
  double work = 0;                                    ///< done on it [J]

  Eigen::Vector3d angularAbout(const Eigen::Vector3d& origin) const { return angular - origin.cross(linear); }
};

class Surfaces {
 public:
  /// Forgets the last step. `collider` is asked until the next begin.
  void begin(const DebrisCollider& collider);

  /// Motion now, valid until another surface is asked for. Throws rubble::Error when the collider gives
  /// numbers that are not finite.
  const DebrisSurface& of(std::uint32_t id);

  /// Work that `lost`, taken from a piece, would do on the surface now [J].
  double workOf(std::uint32_t id, const Impulse& lost);
  /// Gives the surface minus `lost`, the change of a piece's motion; returns the work done on it [J].
  double give(std::uint32_t id, const Impulse& lost);

  std::size_t count() const { return m_placeOf.size(); }
  /// Of the surfaces hit in this step, in the order of their first hits.
  std::span<const SurfaceImpulse> impulses() const { return m_impulses; }

 private:
  std::uint32_t place(std::uint32_t id);

  const DebrisCollider* m_collider = nullptr;
  std::vector<std::uint32_t> m_placeOf;  // by id, in the two lists below
  std::vector<DebrisSurface> m_motions;
  std::vector<SurfaceImpulse> m_impulses;
};

}  // namespace rubble::debris
