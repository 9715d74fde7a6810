// Stiff and extreme cases as data. Case n is the n-th point of a low-discrepancy sequence over all dimensions
// at once, so any prefix of the cases covers every dimension evenly, and a case is known by its number alone.
#pragma once

#include <string>

#include "rubble/material.h"
#include "rubble/regime.h"

namespace rubble::stability {

enum class Shape { Block, Plate, Needle, Sliver, Packed };
enum class Strength { Usual, Zero, Infinite };
enum class Impactor { None, Ball, Box, Plate, Capsule, Cylinder, Kinematic, Destructible };
/// What the application does in the middle of the run.
enum class Happening {
  None,
  Pause,             ///< steps of no length
  TeleportImpactor,  ///< into the middle of the elements
  RemoveImpactor,
  RemoveBody,
  Strike,        ///< Destruction::strike
  HugeForce,     ///< on the impactor: 1e6 times its weight under 10 m/s^2, for one tick
  NaNVelocity,   ///< of the impactor
  NaNPlace,      ///< of the impactor
  NaNOnBody,     ///< velocity of the destructible body, by Bullet's own setter
  InfiniteForce  ///< on the impactor
};

struct Case {
  int number = 0;
  // The body: concrete_soft with another modulus; its strengths keep their ratio to it.
  double stiffness = 1;        ///< of concrete_soft's modulus [-], 1e-6 to 1e6
  double radius = 0.05;        ///< of the elements [m], 1 mm to 100 m
  int elements = 64;           ///< wanted, 1 to 3000
  Shape shape = Shape::Block;  ///< of grid cubes, but for Packed, which is cooked
  Strength strength = Strength::Usual;
  double springDamping = 0.03;    ///< [-], 0 to 0.5
  double contactDamping = 0.3;    ///< [-], 0 to 1
  double massDamping = 0;         ///< [1/s], 0 to 1e4
  double contactStiffness = 0.5;  ///< [-], 0.01 to 10
  double restitution = 0;         ///< [-], 0 to 1
  double friction = 0.6;          ///< [-], 0 to 10
  bool paper = false;             ///< Model::paper()
  bool anchored = false;
  double distance = 0;  ///< from the origin [m], 0 to 10 km
  double spin = 0;      ///< [rad/s], 0 to 1000
  // What meets it.
  Impactor impactor = Impactor::Ball;
  double massRatio = 1;  ///< of the impactor and one element [-], 1e-6 to 1e6
  double size = 3;       ///< half width of the impactor [radii], 0.3 to 30
  double speed = 10;     ///< towards the body [m/s], 0 to 1000
  // The world.
  double gravity = 9.81;        ///< downwards [m/s^2], 0 to 1e4
  double frameStep = 1.0 / 60;  ///< [s], 1/1000 to 1/15
  bool jumping = false;         ///< the step is 1/4 to 4 times that, within the same limits
  Precision precision = Precision::Float;
  Regime regime = Regime::Elements;
  bool breaking = true;
  Happening happening = Happening::None;
};

/// Case `number`, 0 or more.
Case stabilityCase(int number);
/// All fields, one line, names first.
std::string describe(const Case& c);

const char* nameOf(Shape shape);
const char* nameOf(Strength strength);
const char* nameOf(Impactor impactor);
const char* nameOf(Happening happening);

/// Of the body's elements: every number of the case in one place [kg], [Pa].
Material materialOf(const Case& c);
double elementMass(const Case& c);
/// Substeps times elements that a case may take. Sets how stiff a body may be for its size and number.
inline constexpr double kWorkBudget = 6e5;
/// The most substeps that the case may take in 1/60 s, by that budget.
int maxSubsteps(const Case& c);

}  // namespace rubble::stability
