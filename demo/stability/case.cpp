#include "demo/stability/case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace rubble::stability {
namespace {

// Coordinates of the n-th point of the Kronecker sequence frac(1/2 + n sqrt(prime)), one dimension a call.
class Point {
 public:
  explicit Point(int number) : m_number(number) {}

  double share() {
    static constexpr std::array<int, 32> kPrimes = {2,  3,  5,  7,   11,  13,  17,  19,  23,  29, 31,
                                                    37, 41, 43, 47,  53,  59,  61,  67,  71,  73, 79,
                                                    83, 89, 97, 101, 103, 107, 109, 113, 127, 131};
    const double at = 0.5 + m_number * std::sqrt(double(kPrimes.at(m_dimension++)));
    return at - std::floor(at);
  }
  double logarithmic(double low, double high) { return low * std::pow(high / low, share()); }
  /// 0 in `zeros` of all cases.
  double zeroOrLogarithmic(double zeros, double low, double high) {
    const double u = share();
    return u < zeros ? 0 : low * std::pow(high / low, (u - zeros) / (1 - zeros));
  }
  bool chance(double of) { return share() < of; }
  /// Each equally often; twice named, twice as often.
  template <class T>
  T oneOf(std::initializer_list<T> list) {
    return list.begin()[std::size_t(share() * double(list.size()))];
  }

 private:
  int m_number;
  std::size_t m_dimension = 0;
};

// Substeps of one tick of the case's body alone: a grid of edge h needs 0.44 h / c, at 0.9 of that.
double substepsATick(const Case& c) {
  const Material m = materialOf(c);
  return c.frameStep * std::sqrt(m.youngsModulus / m.density) / (0.9 * 0.44 * 2 * c.radius);
}

// The budget is spent on at least so many ticks.
constexpr double kLeastTicks = 6;

// A body that is too stiff for its size and number is refused, which one case in four is to see; the others
// get fewer and larger elements, then a softer material, until a run fits into the budget.
void fit(Case& c) {
  const auto allowed = [&] { return kWorkBudget / kLeastTicks / c.elements / 2; };
  if (substepsATick(c) > allowed()) c.elements = std::max(1, int(std::sqrt(double(c.elements))));
  if (substepsATick(c) > allowed()) c.radius = std::min(100.0, c.radius * substepsATick(c) / allowed());
  if (substepsATick(c) > allowed()) c.stiffness *= std::pow(allowed() / substepsATick(c), 2);
}

template <std::size_t N, class Enum>
const char* pick(const std::array<const char*, N>& names, Enum value) {
  return names.at(std::size_t(value));
}

}  // namespace

Case stabilityCase(int number) {
  Point point(number);
  Case c;
  c.number = number;
  c.stiffness = point.logarithmic(1e-6, 1e6);
  c.radius = point.logarithmic(1e-3, 100);
  c.elements = int(point.logarithmic(1, 3000));
  c.shape = point.oneOf({Shape::Block, Shape::Block, Shape::Block, Shape::Plate, Shape::Plate, Shape::Needle,
                         Shape::Needle, Shape::Sliver, Shape::Sliver, Shape::Packed});
  c.strength = point.oneOf({Strength::Usual, Strength::Usual, Strength::Zero, Strength::Infinite});
  c.springDamping = point.oneOf({0.0, 0.03, 0.03, 0.5});
  c.contactDamping = point.oneOf({0.0, 0.3, 0.3, 1.0});
  c.massDamping = point.zeroOrLogarithmic(0.6, 0.1, 1e4);
  c.contactStiffness = point.logarithmic(0.01, 10);
  c.restitution = point.oneOf({0.0, 0.0, 0.5, 1.0});
  c.friction = point.oneOf({0.0, 0.6, 0.6, 10.0});
  c.paper = point.chance(0.1);
  c.anchored = point.chance(0.3);
  c.distance = point.zeroOrLogarithmic(0.5, 1, 1e4);
  c.spin = point.zeroOrLogarithmic(0.5, 0.01, 1e3);
  c.impactor = point.oneOf({Impactor::None, Impactor::Ball, Impactor::Ball, Impactor::Box, Impactor::Plate,
                            Impactor::Capsule, Impactor::Cylinder, Impactor::Kinematic,
                            Impactor::Destructible, Impactor::Destructible});
  c.massRatio = point.logarithmic(1e-6, 1e6);
  c.size = point.logarithmic(0.3, 30);
  c.speed = point.zeroOrLogarithmic(0.1, 0.01, 1e3);
  c.gravity = point.oneOf({0.0, 9.81, 9.81, -1.0, -1.0});
  const double strange = point.logarithmic(0.01, 1e4);
  if (c.gravity < 0) c.gravity = strange;
  c.frameStep = point.logarithmic(1e-3, 1.0 / 15);
  c.jumping = point.chance(0.25);
  c.precision = point.chance(0.25) ? Precision::Double : Precision::Float;
  c.regime = point.chance(0.25) ? Regime::RigidUntilStruck : Regime::Elements;
  c.breaking = point.chance(0.7);
  c.happening = Happening(std::max(0, int(point.share() * 20) - 9));
  if (!point.chance(0.25)) fit(c);
  return c;
}

Material materialOf(const Case& c) {
  Material m = material("concrete_soft");
  m.name = "case" + std::to_string(c.number);
  m.youngsModulus *= c.stiffness;
  m.tensileStrength *= c.stiffness;
  m.compressiveStrength *= c.stiffness;
  if (c.strength == Strength::Zero) m.tensileStrength = m.compressiveStrength = 0;
  if (c.strength == Strength::Infinite) m.tensileStrength = m.compressiveStrength = 1e13;
  m.springDamping = c.springDamping;
  m.contactDamping = c.contactDamping;
  m.contactStiffness = c.contactStiffness;
  m.restitution = c.restitution;
  m.friction = c.friction;
  return m;
}

double elementMass(const Case& c) {
  return materialOf(c).density * std::pow(2 * c.radius, 3);
}

int maxSubsteps(const Case& c) {
  return int(std::clamp(kWorkBudget / kLeastTicks / c.elements / (60 * c.frameStep), 20.0, 1e5));
}

const char* nameOf(Shape shape) {
  return pick(std::array{"block", "plate", "needle", "sliver", "packed"}, shape);
}
const char* nameOf(Strength strength) {
  return pick(std::array{"usual", "zero", "infinite"}, strength);
}
const char* nameOf(Impactor impactor) {
  return pick(std::array{"none", "ball", "box", "plate", "capsule", "cylinder", "kinematic", "destructible"},
              impactor);
}
const char* nameOf(Happening happening) {
  return pick(std::array{"none", "pause", "teleport impactor", "remove impactor", "remove body", "strike",
                         "huge force", "NaN velocity", "NaN place", "NaN on body", "infinite force"},
              happening);
}

std::string describe(const Case& c) {
  char text[900];
  std::snprintf(
      text, sizeof text,
      "case %d: stiffness %.3g, radius %.3g m, elements %d, shape %s, strength %s, springDamping %g, "
      "contactDamping %g, massDamping %.3g/s, contactStiffness %.3g, restitution %g, friction %g, paper %d, "
      "anchored %d, distance %.3g m, spin %.3g rad/s, impactor %s, massRatio %.3g, size %.3g radii, speed "
      "%.3g m/s, gravity %.3g m/s^2, frameStep %.3g s, jumping %d, precision %s, regime %s, breaking %d, "
      "happening %s",
      c.number, c.stiffness, c.radius, c.elements, nameOf(c.shape), nameOf(c.strength), c.springDamping,
      c.contactDamping, c.massDamping, c.contactStiffness, c.restitution, c.friction, c.paper, c.anchored,
      c.distance, c.spin, nameOf(c.impactor), c.massRatio, c.size, c.speed, c.gravity, c.frameStep, c.jumping,
      c.precision == Precision::Double ? "double" : "float",
      c.regime == Regime::Elements ? "elements" : "rigid_until_struck", c.breaking, nameOf(c.happening));
  return text;
}

}  // namespace rubble::stability
