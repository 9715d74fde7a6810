// A scene as plain data: everything a run needs to know, with the defaults of every key. SI units, y is up.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "demo/place.h"
#include "demo/slab_mesh.h"
#include "rubble/material.h"
#include "rubble/regime.h"

namespace rubble::demo {

/// Where something stands at the start and how it moves.
struct Placement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< of the centre [m]
  Eigen::Vector3d rotationDegrees = Eigen::Vector3d::Zero();  ///< axis times angle [degrees]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();         ///< [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();             ///< axis times rate [rad/s]
};

/// Something that can break: a solid by its name, that in a mesh file, or an asset that was cooked before.
struct SceneObject : Placement {
  std::filesystem::path mesh = {};  ///< empty: none
  double scale = 1;                 ///< of one unit of the mesh [m]
  bool isScaleGiven = false;
  bool repair = false;               ///< the mesh, before it is cooked
  std::filesystem::path asset = {};  ///< empty: none
  /// The place in the mesh's coordinates, or in those of the asset's mesh, that stands at `position` [m].
  Eigen::Vector3d meshOrigin = Eigen::Vector3d::Zero();
  enum class Shape { Box, Cylinder, Sphere, Torus, Column, Slab, Statue, BrickCourse };
  Shape shape = Shape::Box;
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< full edge lengths of the box, or the one around it [m]
  std::uint32_t segments = 32;                     ///< flat strips around what is round
  double shaft = 0;                                ///< diameter, of a column [m]; 0: chosen
  double plinth = 0;                               ///< height of a column's base and capital [m]; 0: chosen
  std::vector<Opening> openings = {};              ///< of a slab
  std::uint32_t bricks = 4;                        ///< of a brick course
  double joint = 0.01;                             ///< between its bricks [m]
  double offset = 0;                               ///< of its joints [a brick and a joint]
  std::uint32_t elements = 2048;
  double radius = 0;  ///< of the elements [m]; 0: chosen so that the spheres fill `fill` of the solid
  double fill = 0.48;
  std::optional<Eigen::Vector3d> anchor;  ///< the world's direction of the side that is tied to it
  /// What has its centroid in this is tied, too; in the mesh's coordinates, or the shape's about its centre.
  std::optional<Eigen::AlignedBox3d> anchorBox;
  /// What the anchors hold to in place of the world: `impactors.0`, `statics.1`; empty: the world.
  std::string anchorBody = {};
  double massDamping = 0;  ///< of the deformation [1/s]
  Regime regime = Regime::RigidUntilStruck;
  Material material;
  Model model;
};

/// A rigid body of Bullet's own: an impactor when it moves, else static.
struct SceneBody : Placement {
  enum class Shape { Sphere, Box, Hull, Plane };
  Shape shape = Shape::Sphere;
  double radius = 0.1;                                ///< of a sphere [m]
  Eigen::Vector3d size = Eigen::Vector3d::Ones();     ///< full edge lengths of a box [m]
  std::vector<Eigen::Vector3d> points;                ///< of a hull [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  ///< of a plane
  double offset = 0;                                  ///< of a plane along its normal [m]
  double mass = 0;                                    ///< [kg]; 0 is static
  double friction = 0.6;
  double restitution = 0;
};

struct SceneCamera {
  Eigen::Vector3d eye = Eigen::Vector3d(2, 1.5, 3);     ///< [m]
  Eigen::Vector3d target = Eigen::Vector3d(0, 0.5, 0);  ///< [m]
  double fieldOfViewDegrees = 45;                       ///< vertical
};

struct SceneLight {
  Eigen::Vector3d direction = Eigen::Vector3d(0.55, -0.72, -0.42);  ///< in which the light travels
  double ambient = 1;                                               ///< factor on the light of sky and ground
};

enum class DustBackend { Auto, Cpu, Gl };

struct SceneDust {
  DustBackend backend = DustBackend::Auto;
  int resolution = 64;
  Eigen::Vector3d min = Eigen::Vector3d(-2, 0, -2);  ///< corner of the box [m]
  Eigen::Vector3d max = Eigen::Vector3d(2, 3, 2);    ///< [m]
  double opacity = 1;
  double vorticity = 0.3;
  double drag = 0;  ///< [1/s]
  int pressureCycles = 3;
};

struct SceneDebris {
  std::uint32_t budget = 100000;  ///< pieces alive at one time
};

struct Scene {
  std::string name;                                        ///< the file's stem: names the output folder
  std::string file;                                        ///< as errors name it
  Eigen::Vector3d gravity = Eigen::Vector3d(0, -9.81, 0);  ///< [m/s^2]
  double bulletRate = 240;                                 ///< ticks of Bullet [Hz]
  int frames = 180;
  double fps = 60;
  std::uint64_t seed = 1;
  Precision precision = Precision::Float;
  int maxSubstepsPerFrame = 20000;
  double substepSafety = 0.9;
  std::uint32_t fragmentBodyElements = 0;
  std::uint32_t maxNewBodies = 2;
  bool sleep = true;
  bool breaking = true;
  bool crushing = true;
  std::uint32_t maxEvents = 1u << 20;
  std::vector<SceneObject> objects;
  std::vector<SceneBody> impactors;
  std::vector<SceneBody> statics;
  SceneCamera camera;
  SceneLight light;
  std::optional<SceneDust> dust;      ///< absent: no grid, no thread, no memory
  std::optional<SceneDebris> debris;  ///< absent: crushed elements leave no particles
  Origins origins = {};               ///< who gave which value

  /// Who gave what stands at `path`, as errors begin: a file, and the options that gave a value there, below
  /// or at `others`.
  std::string blamed(const std::string& path, std::vector<std::string> others = {}) const;
};

/// One change of the scene from the command line: `objects.0.radius` and a JSON value or a bare word.
struct Override {
  std::string path;
  std::string value;
  std::string source = "--set";  ///< as errors name it
};
/// Splits `key.path=value`. Throws InputError.
Override parseOverride(const std::string& text, const std::string& source = "--set");

/// Reads, merges, checks. `nameOrPath` is a name in the folder of scenes or a path to a JSON file. Throws
/// InputError with one line that names file, key, value and what is allowed; nothing else has happened then.
Scene loadScene(const std::string& nameOrPath, const std::vector<Override>& overrides = {});

/// Folder of the scenes: RUBBLE_DATA/scenes if that variable is set, else where the program was built or
/// installed.
std::filesystem::path sceneFolder();
/// Names of the bundled scenes, comma-separated.
std::string sceneNames();
/// Folder of the shaders, found alike.
std::filesystem::path shaderFolder();

/// Which entry of a list of `count` the path means, as `statics.1` does in `statics`.
std::optional<std::size_t> entryNamed(const std::string& path, const std::string& list, std::size_t count);

/// Every key of the scene with its value, defaults and presets spelt out: "objects.0.material.density =
/// 2400". Two scenes with the same lines simulate the same.
std::vector<std::string> listScene(const Scene& scene);

/// The tables of all keys as Markdown; demo/scenes/README.md holds them, and a test compares.
std::string describeKeys();

}  // namespace rubble::demo
