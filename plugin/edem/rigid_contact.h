// What an element and a rigid body of the host have between them, as plain data.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "edem/contact.h"
#include "edem/corner_memory.h"
#include "edem/stable_step.h"

namespace rubble::edem {

/// What faces remember of a rigid body beside their contact's memory.
struct FaceMemory {
  double deepest = 0;  ///< at the last instant, but for its corners; 0: out of it [m]
  double sunk = 0;     ///< depth without force: first seen as deep, or given way by [m]
  double area = 0;     ///< exposed at the last instant [m^2]
  double yielded = 0;  ///< given way by in the last step [m]
};

/// How far an element was from a rigid body when that was last worked out.
struct Clearance {
  double gap = 0;   ///< no point of its cell can touch before it has come this far; 0: not known [m]
  double area = 0;  ///< exposed then [m^2]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< the element's centre, frame of the rigid body [m]
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< from the axes of the element at rest
};

/// An element and a rigid body that are near each other.
struct RigidContact {
  std::uint32_t proxy, body, element;  ///< places
  bool touching = false;
  ContactMemory<double> memory;
  FaceMemory faces;
  double weight = 0;         ///< sum of all that may press at once, over k_n
  double mode = 0;           ///< its highest frequency^2, over k_n / m
  double dampingWeight = 0;  ///< the same for its dashpots, over eta_n / m
  double lone = 0;           ///< the weight of what acts at once, without levers
  double balls = 0;          ///< weights of corners, edges and spheres near
  double edges = 0;          ///< of them those of edges
  double mobility = 0;       ///< what an impulse of 1 moves the rigid body by there, at most [1/kg]
  bool core = false;         ///< near
  bool cornered = true;      ///< corners of the rigid body may have been in the element at the last instant
  std::uint32_t push = 0;    ///< while touching: into the pushes of this substep
  Clearance clear;           ///< while not touching
  bool apart = false;        ///< nothing of it can touch in this substep
  double exposed = 0;        ///< area of exposed faces when the weights were taken [m^2]
};

/// Load of a contact at an instant.
struct RigidTouch {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< contact point, world [m]
  Eigen::Vector3d x = Eigen::Vector3d::Zero();   ///< centre of the element [m]
  /// On the element, in its own scalar, and their lost part [N], [N m].
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  Eigen::Vector3d dampingForce = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();
  double energy = 0;                               ///< in its springs [J]
  double slipped = 0;                              ///< lost by them since the last instant [J]
  double weight = 0;                               ///< stiffness of what presses, over k_n
  double power = 0;                                ///< of the elastic loads [W]
  Eigen::Vector3d full = Eigen::Vector3d::Zero();  ///< normal force on it before any is withheld [N]
  std::size_t resting = 0;                         ///< place among the resting loads
};

/// Where a rigid body is and how it moves.
struct RigidPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Work of a rigid body in half of a substep, by its own motion [J].
struct HalfWork {
  double given = 0;      ///< to elements and to contacts' springs
  double byAnchors = 0;  ///< of that
  double lost = 0;       ///< less than 0
};

/// What the contacts of one rigid body have in common.
struct RigidState {
  std::uint64_t key = 0;
  RigidPose left;      ///< when the last substep was over
  bool moved = false;  ///< by the host since
  bool leapt = false;  ///< put elsewhere by the application since: nothing that touched it does
  bool still = false;  ///< does not move, and has not since the last tick
  /// On the rigid body in this substep, and the part of it that is lost energy [N], [N m].
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  Eigen::Vector3d dampingForce = Eigen::Vector3d::Zero(), dampingTorque = Eigen::Vector3d::Zero();
  Eigen::Vector3d anchorForce = Eigen::Vector3d::Zero();  ///< of them those of anchors
  Eigen::Vector3d anchorTorque = Eigen::Vector3d::Zero();
  double size = 0;         ///< sum of |force| of contacts [N]
  double pressed = 0;      ///< the same in the last substep [N]
  double pressedRate = 0;  ///< its frequency^2 on what presses it in this substep [1/s^2]
  bool struck = false;     ///< it came fast enough for a blow when the substep was chosen
  Eigen::Vector3d listedPosition = Eigen::Vector3d::Zero();
  Eigen::Quaterniond listedOrientation = Eigen::Quaterniond::Identity();
  HalfWork halfWork;                     ///< up to this instant, by the velocity before it
  double surplusNext = 0;                ///< second half step of RigidProxy::surplus [J]
  double mobility = 0;                   ///< sum over contacts of speed / impulse [1/kg]
  double rate = 0;                       ///< the same, times the stiffness of each [1/s^2]
  double edgeRate = 0;                   ///< the same of edges alone, each point at all that it is near
  double edgeMost = 0;                   ///< the most of it for one point of weight h [1/(m s^2)]
  ElementRates rates;                    ///< of the rigid body, all contacts touching
  std::vector<ContactLaw<double>> laws;  ///< by body
  CornerMemories corners;
};

}  // namespace rubble::edem
