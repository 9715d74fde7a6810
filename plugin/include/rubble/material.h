// What a destructible object is made of, and which reading of the paper is used. SI units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rubble {

/// All constants of a material. Presets: `material("concrete_soft")` and others, see materialNames().
struct Material {
  std::string name = "concrete_soft";
  double density = 2400;             ///< of the solid [kg/m^3], > 0
  double youngsModulus = 30e6;       ///< E of the pore springs, k = E A / |d0| [Pa], > 0
  double tensileStrength = 0.2e6;    ///< f_t of the solid [Pa], >= 0
  double compressiveStrength = 2e6;  ///< f_c of the solid [Pa], >= f_t
  /// Relative rotation at which a spring breaks under the paper's criterion [rad], > 0.
  double breakingAngle = 0.013;
  /// |dx| / |d0| at which a spring breaks under the paper's criterion, dimensionless.
  double stretchThreshold = 0.0067;
  /// Damping ratio xi of the springs' dashpots at the highest frequency, 0 to 0.5.
  double springDamping = 0.03;
  double contactStiffness = 0.5;  ///< k_cn = contactStiffness E h [-], h the element spacing
  double contactDamping = 0.3;    ///< damping ratio of the contact dashpots, normal and tangential, 0 to 1
  double friction = 0.6;          ///< Coulomb mu of contacts
  /// e of a blow; a contact has the product of both bodies', as Bullet has it. 0 to 1.
  double restitution = 0;
  double rollingFriction = 0.5;  ///< mu_r of rolling and twisting, in radii of curvature, 0 to 1

  double bondWorkIndex = 13.5;  ///< Wi [kWh/t]; measured for the real material
  /// Share of Bond's (mill) energy that fracture energy must supply, dimensionless; chosen.
  double crushEfficiency = 4e-3;
  double sizeModulus = 0.7;  ///< m of the Gaudin-Schuhmann distribution, 0 < m <= 1
  double dustRadius = 1e-6;  ///< R_dust, radius of the largest dust grain [m]
  /// Relative speed of debris / speed of the element, the paper's user value, dimensionless.
  double debrisSpeed = 0.3;
};

/// A preset by name. Throws rubble::Error naming the presets.
Material material(std::string_view name);
std::vector<std::string> materialNames();

enum class BreakCriterion {
  MohrCoulomb,  ///< default: tension, compression and shear strength on the stresses of the spring's face
  Stretch       ///< the paper: |dx| / |d0| passes a threshold in any direction, or the rotation its angle
};
enum class DebrisSizes {
  Mass,   ///< default: each piece carries an equal share of the mass
  Number  ///< the paper's eq. (5): sizes evenly spaced by number
};
enum class CellJoining {
  Transitive,  ///< default: cells joined through any chain of unbroken springs at a vertex are drawn joined
               ///< there
  Direct       ///< the paper: only cells joined by a spring of their own
};

/// Which reading of the paper is simulated. The default values are `default`; `Model::paper()` follows the
/// paper to the letter. Every difference is marked DEVIATION in the code and listed in plugin/README.md.
struct Model {
  BreakCriterion breakCriterion = BreakCriterion::MohrCoulomb;
  /// Springs act as whole faces: at the face's centroid, and with k_rot against bending and twist; off in the
  /// paper.
  bool rotationalStiffness = true;
  /// Spring and contact act together on a joined pair, as printed in the paper.
  bool contactBesideSpring = false;
  bool coulombFriction = true;  ///< friction limited by mu |F_n|; off in the paper
  /// Contacts remember what slid and rolled: things stand on slopes and come to rest; off in the paper.
  bool contactMemory = true;
  /// Rigid bodies touch the outer and broken faces of the cells, not the elements' spheres; off in the paper.
  bool cellFaces = true;
  bool conserveDebris = true;  ///< debris keep momentum, spin and energy of their element
  DebrisSizes debrisSizes = DebrisSizes::Mass;
  CellJoining cellJoining = CellJoining::Transitive;

  static Model paper();  ///< its bodies are Regime::Elements, too: that is no part of a model
};

/// Scalar of the elements' state. One source, both compiled in.
enum class Precision { Float, Double };

}  // namespace rubble
