// Virtual tests of a packed cube: pulled, or pressed, along z. Slow, without gravity. They tell what a
// packing reaches of what its material asks for.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "edem/one_body.h"

namespace rubble::edem {

/// How the machine's flat plates hold the cells at the cube's two ends. Either way the cells' faces follow
/// the plates.
enum class Plates {
  Glued,   ///< nothing of them moves by itself
  Greased  ///< they slide along the plates and turn about z freely
};

/// A cube about the origin, its edges along the axes.
struct TestCube {
  std::shared_ptr<const Asset> asset;
  double edge;  ///< [m], > 0
};

/// The machine. Within the end cells the strain is that of the whole cube, so that they load the rest evenly.
class TestingMachine {
 public:
  /// `speed` is that of the plates away from each other [m/s].
  TestingMachine(TestCube cube, const Material& material, Plates plates, double speed);

  /// Mean stress on the cross-section, positive in tension, over the time that sound takes there and back
  /// [Pa].
  double read(bool breaking = true);
  /// Now; positive in tension.
  double strain() const { return m_speed * m_time / m_cube.edge; }
  /// Springs.
  std::uint32_t broken() { return m_one.body().state.brokenCount; }

 private:
  struct Held {
    std::uint32_t element;
    double end;  // -1 or 1
  };

  double velocityOf(std::uint32_t i) const;
  void guide();

  TestCube m_cube;
  OneBody<double> m_one;
  Plates m_plates;
  double m_speed;
  std::vector<Held> m_held;
  double m_step = 0;  // [s]
  int m_stepsPerReading = 0;
  double m_time = 0;  // [s]
};

/// Largest stress that the cube carries before it has lost half of it, or until the strain is `strainEnd`
/// [Pa]. Speed < 0 presses.
double strengthOf(const TestCube& cube, const Material& material, Plates plates, double speed,
                  double strainEnd);

/// Young's modulus of the cube between greased plates, without breaking [Pa]; at this speed [m/s] until sound
/// has crossed it forty times.
double modulusOf(const TestCube& cube, const Material& material, double speed);

}  // namespace rubble::edem
