#include "rubble/material.h"

#include <array>

#include "rubble/error.h"

namespace rubble {
namespace {

// Assumed, typical of the named material: densities, Bond indices, and `concrete`'s modulus and strengths.
// The `_soft` ones are softened for games: their moduli, strengths and angles are chosen, not those of any
// real material. concrete_soft has a thousandth of concrete's modulus and twice the strength that sqrt(E)
// asks for, by which a blow's stress rho c v keeps its ratio to it. Chosen for the eye everywhere:
// crushEfficiency and debrisSpeed.
std::array<Material, 4> presets() {
  Material softConcrete;
  Material concrete;
  concrete.name = "concrete";
  concrete.youngsModulus = 30e9;
  concrete.tensileStrength = 3e6;
  concrete.compressiveStrength = 30e6;
  concrete.breakingAngle = 1e-3;
  concrete.stretchThreshold = 1e-4;
  concrete.crushEfficiency = 1e-3;
  Material softBrick = softConcrete;
  softBrick.name = "brick_soft";
  softBrick.density = 1900;
  softBrick.bondWorkIndex = 11.8;
  softBrick.tensileStrength = 0.12e6;
  softBrick.compressiveStrength = 1.2e6;
  softBrick.breakingAngle = 0.008;
  softBrick.stretchThreshold = 0.004;
  Material softGlass = softConcrete;
  softGlass.name = "glass_soft";
  softGlass.density = 2500;
  softGlass.bondWorkIndex = 3.08;
  softGlass.youngsModulus = 60e6;
  softGlass.tensileStrength = 0.36e6;
  softGlass.compressiveStrength = 7.2e6;
  softGlass.stretchThreshold = 0.006;
  softGlass.friction = 0.4;
  return {softConcrete, concrete, softBrick, softGlass};
}

}  // namespace

Material material(std::string_view name) {
  std::string known;
  for (const Material& m : presets()) {
    if (m.name == name) return m;
    known += (known.empty() ? "" : ", ") + m.name;
  }
  throw Error("material: \"" + std::string(name) + "\" is not known, must be one of " + known);
}

std::vector<std::string> materialNames() {
  std::vector<std::string> names;
  for (const Material& m : presets()) names.push_back(m.name);
  return names;
}

Model Model::paper() {
  Model model;
  model.breakCriterion = BreakCriterion::Stretch;
  model.rotationalStiffness = false;
  model.contactBesideSpring = true;
  model.coulombFriction = false;
  model.contactMemory = false;
  model.cellFaces = false;
  model.conserveDebris = false;
  model.debrisSizes = DebrisSizes::Number;
  model.cellJoining = CellJoining::Direct;
  return model;
}

}  // namespace rubble
