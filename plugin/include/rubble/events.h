// What happened since events were last taken: for sound, game logic, dust and drawing. Plain arrays.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "rubble/dust_source.h"

namespace rubble {

/// Why a spring broke.
enum class BreakMode : std::uint8_t { Tension, Compression, Shear, Rotation, Stretch, Crushed };

struct SpringBroken {
  std::uint32_t body;    ///< DestructibleBody::id()
  std::uint32_t spring;  ///< into Asset::springs, or Asset::springs.size() + anchor
  BreakMode mode;
  float energy;              ///< released [J]
  Eigen::Vector3f position;  ///< [m]
};

struct ElementCrushed {
  std::uint32_t body;
  std::uint32_t element;
  std::uint32_t pieces;      ///< debris spawned
  float mass;                ///< [kg], dust included
  float dustMass;            ///< [kg]
  float fractureEnergy;      ///< W_I of eq. (3) [J]
  float maxRadius;           ///< R_max of eq. (4) [m]
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f velocity;  ///< [m/s]
};

struct DebrisSpawned {
  std::uint32_t body;
  std::uint32_t element;
  float radius;  ///< R [m]
  float mass;    ///< [kg]
};

struct FragmentSplit {
  std::uint32_t body;
  std::uint32_t root;      ///< lowest element of the fragment
  std::uint32_t elements;  ///< how many it has
  float mass;              ///< [kg]
};

/// A fragment has become a body of its own: Destruction::body(newBody) is in the world, with the collision
/// filter, factors and gravity of the one that it comes from.
struct BodySplit {
  std::uint32_t body;
  std::uint32_t newBody;
  std::uint32_t root;      ///< lowest element of the fragment, in both
  std::uint32_t elements;  ///< how many it has
  float mass;              ///< [kg]
};

/// Sum over one tick of what a Bullet body and a destructible body did to each other while its elements moved
/// it. What touches a whole body is in Bullet's manifolds, as of any rigid body.
struct ContactImpulse {
  std::uint32_t body;
  const void* other;         ///< the btCollisionObject
  float impulse;             ///< size of the summed impulse [N s]
  Eigen::Vector3f position;  ///< impulse-weighted mean [m]
};

struct Events {
  std::vector<SpringBroken> springsBroken;
  std::vector<ElementCrushed> elementsCrushed;
  std::vector<DebrisSpawned> debrisSpawned;
  std::vector<FragmentSplit> fragmentsSplit;
  std::vector<BodySplit> bodiesSplit;
  std::vector<ContactImpulse> contacts;
  std::vector<DustSource> dustSources;
  /// What was dropped because a list was full; 0 in a healthy run. Raise DestructionDef::maxEvents.
  std::uint32_t dropped = 0;

  void clear();
};

}  // namespace rubble
