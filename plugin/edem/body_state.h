// The state of a body: all that a tick starts from. A copy of it is a snapshot.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edem/anchor_base.h"
#include "edem/cell_faces.h"
#include "edem/host_load.h"
#include "edem/spring.h"
#include "edem/types.h"

namespace rubble::edem {

template <class Real>
struct BodyState {
  // Frame 0 where no base moves it, moved by the host alone; positions and `BodyWork::rest` are relative to
  // this origin.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();

  // Motion.
  std::vector<Frame> frames;             ///< frame 0, then one of each fragment without anchors
  std::vector<std::uint32_t> frameOf;    ///< each element's, into `frames`
  std::vector<Vec3<Real>> displacement;  ///< u_I [m]
  std::vector<Quat<Real>> rotation;      ///< R'_I
  std::vector<Vec3<Real>> velocity;      ///< at the half step before the positions [m/s]
  /// What float addition lost of velocity (compensated summation) [m/s].
  std::vector<Vec3<Real>> velocityCarry;
  std::vector<Vec3<Real>> spin;  ///< [rad/s]

  // What holds together.
  std::vector<Spring<Real>> springs;  ///< then anchors, whose far end is a fixed point
  std::vector<std::uint8_t> alive;
  std::vector<std::uint8_t> intact;  ///< springs, then anchors
  Exposure exposure;                 ///< of BodyConstants::cells
  std::vector<Real> range;           ///< D of each pair [m]
  std::uint32_t crushedCount = 0;
  std::uint32_t brokenCount = 0;
  std::uint32_t anchorsIntact = 0;
  /// What other bodies have of the constants' elements and springs since they split off (split.h).
  std::uint32_t absentElements = 0, absentSprings = 0;
  AnchorBase base;        ///< what the far ends of anchors move with
  FarEnds<Real> farEnds;  ///< now

  // Fragments, as labelled last.
  /// Lowest element connected with I through springs; kNoElement if crushed.
  std::vector<std::uint32_t> fragment;
  std::uint32_t fragmentCount = 0;
  std::uint32_t labelledBroken = 0;    ///< brokenCount when the fragments were labelled
  std::vector<std::uint8_t> anchored;  ///< 1 while an anchor carries the element

  // Sleep (sleep.h).
  std::vector<std::uint8_t> sleeping;  ///< elements of fragments that sleep by themselves
  /// How long each element has been slower than SolverDef::sleepSpeed, and than settleSpeed [s].
  std::vector<float> calmTime, slowTime;
  /// Its largest speed in slowTime [m/s], and whether it has been half as fast since.
  std::vector<float> slowPeak;
  std::vector<std::uint8_t> slowTurned;
  std::uint32_t sleepingCount = 0;
  std::uint64_t sleepChanges = 0;  ///< counts on whenever other elements may sleep
  double energyAsleep = 0;         ///< in the springs of those [J]
  double massAsleep = 0;           ///< of those [kg]

  // What the host asks for.
  bool asleep = false;         ///< all of it, by its host
  double sleepingElastic = 0;  ///< in its springs and own contacts when it fell asleep [J]
  double sleepingMass = 0;     ///< of its elements then [kg]
  bool parked = false;         ///< lent to the host, asleep too (parking.h)
  /// Displacements and rotations in which a body that an anchor holds is parked; empty: none [m].
  std::vector<Vec3<Real>> parkedAt;
  std::vector<Quat<Real>> parkedTurn;
  std::vector<HostLoad> hostLoads;  ///< until the tick ends
  /// Its own in place of the world's [m/s^2].
  std::optional<Eigen::Vector3d> gravity;
  /// The same in every substep, until another spring breaks: while the host lets it bend to a load [1/s].
  double easeDamping = 0;
  std::uint32_t easeBroken = 0;  ///< brokenCount when that began
};

}  // namespace rubble::edem
