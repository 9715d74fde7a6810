// All debris of one world: storage, budget, rest and the books. What one piece does in a step is in
// particle.h.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "debris/debris_collider.h"
#include "debris/flight.h"
#include "debris/motion.h"
#include "debris/particle.h"
#include "debris/spawn.h"
#include "rubble/debris.h"

namespace rubble::debris {

struct DebrisSystemDef {
  std::uint32_t maxDebris = 100000;  ///< budget of live pieces, 1 to 2^24; memory for all is allocated at
                                     ///< once, about 280 bytes a piece
  Air air{};
  double restitution = 0.3;  ///< of hits, 0 to 1; rubble on stone about 0.2 to 0.4
  double restSpeed = 0.02;   ///< no further in restTime than at this speed, and touching: at rest [m/s], >= 0
  double restTime = 0.25;    ///< [s], >= 0
  double reach = 1e4;  ///< pieces with a coordinate beyond this leave and are booked as removed [m], > 0
};

/// Particles with gravity, air drag, swept collisions, rest and a budget. Single-threaded; the order of calls
/// alone determines every bit. A resting piece costs nothing in a step, and weighs nothing on its support.
///
/// The books close by construction: motion() now = motion() before + all of takeExchange() since.
class DebrisSystem {
 public:
  /// Throws rubble::Error when a number is out of range.
  explicit DebrisSystem(const DebrisSystemDef& def);

  /// Takes pieces in. With the budget spent each new piece pushes out the one that has rested longest; when
  /// none rests, the one that has moved longest. Throws rubble::Error, naming the number, for a piece that is
  /// not finite or has no mass; the pieces before it are in.
  void add(std::span<const DebrisParcel> parcels);

  /// Moves everything by dt seconds, 0 to 1e6. Throws rubble::Error for dt, gravity [m/s^2] or a collider's
  /// answer that is not finite; the state is then not to be used any more.
  void step(double dt, const Eigen::Vector3d& gravity, DebrisCollider& collider);

  /// Wakes the resting pieces whose centre is in one of the boxes [m] (that something moves through, or from
  /// which a support went); returns how many. Free when no box meets the bounds of what rests, one pass over
  /// all pieces otherwise: pass all boxes of a tick at once.
  std::uint32_t wake(std::span<const Eigen::AlignedBox3d> boxes);
  /// Wakes the resting pieces that one of these surfaces held; returns how many. One pass over all pieces,
  /// however many surfaces.
  std::uint32_t wakeSupports(std::span<const std::uint32_t> surfaces);

  /// Removes the pieces of one body; returns how many.
  std::uint32_t removeBody(std::uint32_t body);

  /// All live pieces, for drawing. Valid until the next call that is not const.
  std::span<const DebrisPiece> pieces() const { return m_pieces; }
  std::uint32_t movingCount() const { return m_moving.count; }
  std::uint32_t restingCount() const { return m_resting.count; }

  /// Sum over all pieces now.
  Motion motion() const;
  /// All that changed motion() since the last call, and starts anew.
  Exchange takeExchange();
  /// What surfaces received in the last step, in the order of their first hits.
  std::span<const SurfaceImpulse> surfaceImpulses() const { return m_surfaces.impulses(); }
  /// FNV-1a over the bits of all pieces.
  std::uint64_t hash() const;

  const DebrisSystemDef& def() const { return m_def; }

 private:
  // Moving and resting pieces are two lists, in the order in which they began to move or to rest, through
  // arrays without holes: the drawn array is one span, and the piece to give up for the budget is the first
  // of a list.
  struct Link {
    std::uint32_t previous, next;
  };
  struct List {
    std::uint32_t first, last, count;
  };

  void addOne(const DebrisParcel& parcel);
  void beginStep(double dt, const Eigen::Vector3d& gravity, DebrisCollider& collider);
  void updatePiece(std::uint32_t index, double dt);
  bool comesToRest(Particle& particle, double dt) const;
  bool isStray(std::uint32_t index) const;
  void removeStrays();
  void rest(std::uint32_t index, DebrisCollider& collider);
  template <typename Choose>
  std::uint32_t wakeIf(Choose choose);
  void remove(std::uint32_t index);
  void fillHole(std::uint32_t index);
  void append(List& list, std::uint32_t index);
  void unlink(List& list, std::uint32_t index);

  DebrisSystemDef m_def;
  std::vector<Particle> m_particles;
  std::vector<DebrisPiece> m_pieces;  // same order; holds what is constant, too
  std::vector<Link> m_links;          // same order
  List m_moving;
  List m_resting;
  Eigen::AlignedBox3d m_restBounds;  // holds all resting pieces; shrinks only when none rests [m]
  double m_mass = 0;                 // of all pieces [kg]
  Motion m_motion;                   // of the moving ones; those that rest have none
  Exchange m_exchange;
  Surfaces m_surfaces;
  std::vector<std::uint8_t> m_leaving;  // by surface id; all 0 between calls
};

}  // namespace rubble::debris
