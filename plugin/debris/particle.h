// One piece of debris in motion: flight, hits, sliding. Free functions on plain data; every change of motion
// is booked.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "debris/debris_collider.h"
#include "debris/flight.h"
#include "debris/motion.h"
#include "debris/surfaces.h"

namespace rubble::debris {

/// The surfaces that hold a piece. A piece lies in the dimple of three balls, or in a corner of three walls;
/// of more the last ones are kept.
struct Supports {
  std::array<std::uint32_t, 4> ids;
  std::uint32_t count;

  void add(std::uint32_t id);
  const std::uint32_t* begin() const { return ids.data(); }
  const std::uint32_t* end() const { return ids.data() + count; }
};

/// State of a moving or resting piece. In double: positions in float would step by 1e-5 m at 100 m from the
/// origin, and the angular momentum of a small piece could not be closed there.
struct Particle {
  Eigen::Vector3d position;  // [m]
  Eigen::Vector3d velocity;  // [m/s]
  Eigen::Vector3d spin;      // [rad/s]
  double mass;               // [kg]
  double inertia;            // [kg m^2]
  GrainDrag drag;
  double collisionRadius;   // [m]
  double friction;          // Coulomb mu
  Eigen::Vector3d stillAt;  // place that it has not left since [m]
  double stillTime;         // time that it has been there [s]
  std::uint32_t support;    // surface last touched
  Supports supports;        // surfaces touched since it has been still
  bool touched;             // in the last step
  Eigen::Vector3d offset;   // from where it was inside its element, until its first step [m]
};

/// What changed the motion of the debris.
struct Exchange {
  Impulse gravity;  ///< energy: work done by gravity
  Impulse air;      ///< energy: minus what the air took
  Impulse contact;  ///< energy: what hits took (negative) or moving surfaces gave
  /// Work done on the surroundings by contact [J]; contact.energy + workOnSurfaces is minus what contacts
  /// dissipated: restitution, friction, and what a piece had left when it came to rest.
  double workOnSurfaces = 0;
  /// Of contact.energy, what no motion gave: pieces that were set out of what they were in against gravity,
  /// or that waited for a surface to make room, less what that contact dissipated [J], >= 0.
  double placed = 0;
  Motion added;
  Motion removed;
  std::uint64_t addedCount = 0;
  std::uint64_t removedCount = 0;
};

/// Constants of one step.
struct StepInput {
  double dt;                // [s]
  Eigen::Vector3d gravity;  // [m/s^2]
  double restitution;       // of hits
  DebrisCollider* collider;
};

/// Where a step books.
struct StepBooks {
  Exchange* exchange;
  Surfaces* surfaces;
};

/// Motion of one piece.
inline Motion motionOf(const Particle& p) {
  return motionOf(p.mass, p.inertia, p.position, p.velocity, p.spin);
}

/// Moves a piece through one step: flight until a hit, bounce, flight again; where a bounce would be lower
/// than gravity takes back at once, sliding under Coulomb friction for the rest of the step.
void advance(Particle& particle, const StepInput& input, const StepBooks& books);

/// Stops a piece on its support; what it still had is booked as contact.
void bringToRest(Particle& particle, const StepBooks& books);

}  // namespace rubble::debris
