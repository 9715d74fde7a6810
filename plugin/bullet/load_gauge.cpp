#include "bullet/load_gauge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edem/criterion.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// The noise of Bullet's solver and the blows of a landing, which have a rule of their own, last for a few
// ticks; a load rests [s].
constexpr double kSmoothing = 0.1;
// A load that presses alike, within this share, is the same; the smoothing has seen all of it after this time
// [s]. Below the share of the strength it is far from a thaw, at half: it has to change to get there. What
// turns faster than the spin has inertial forces of its own [rad/s].
constexpr double kAlike = 0.05, kSettled = 0.5, kFar = 0.25, kTurns = 0.1;
// Slowest bending of a prism of length L and thickness t on supports at its ends: pi^2 / sqrt(12) t c / L^2.
constexpr double kBendingFrequency = 2.85;

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

// The accelerations of a free body, reversed, with which the contacts are in balance (d'Alembert): gravity
// pulls at all of it alike, and nothing is bent in free fall.
LinearField inertialField(const SpreadWeight& mass, const Wrench& contacts, const Eigen::Vector3d& spin) {
  LinearField field;
  field.offset = -contacts.force / mass.weight;
  const Eigen::Matrix3d inertia = mass.inertia(), turn = crossMatrix(spin);
  const Eigen::Vector3d turning = inertia.ldlt().solve(contacts.moment - spin.cross(inertia * spin));
  field.slope = -crossMatrix(turning) - turn * turn;
  return field;
}

// What the tied surfaces hold against, linear over them as under a stiff footing.
LinearField reactionField(const SpreadWeight& anchors, const Wrench& load) {
  const Eigen::Vector3d middle = anchors.first / anchors.weight;
  SpreadWeight own = anchors;
  own.second -= anchors.weight * middle * middle.transpose();
  const Eigen::Vector3d turning = own.inertia().ldlt().solve(-(load.moment - middle.cross(load.force)));
  LinearField field;
  field.slope = crossMatrix(turning);
  field.offset = -load.force / anchors.weight - turning.cross(middle);
  return field;
}

}  // namespace

LoadGauge::LoadGauge(Sections sections, const Material& material, const Model& model)
    : m_sections(std::move(sections)) {
  const auto limit = edem::makeCriterion<double>(material, model);
  if (limit.kind == BreakCriterion::Stretch) {
    m_tension = m_compression = m_cohesion = material.stretchThreshold * material.youngsModulus;
  } else {
    m_tension = limit.tension;
    m_compression = limit.compression;
    m_cohesion = limit.cohesion;
    m_friction = limit.internalFriction;
  }
  const double sound = std::sqrt(material.youngsModulus / material.density);
  m_slowest = kBendingFrequency * m_sections.thickness * sound / (m_sections.length * m_sections.length);
}

void Pressure::add(double impulse, const Eigen::Vector3d& at) {
  sum += impulse;
  first += impulse * at;
  second += impulse * at.cwiseAbs2();
}

bool LoadGauge::isSettled(const Pressure& contacts, double spin, double dt) {
  const Pressure now{contacts.sum / dt, contacts.first / dt, contacts.second / dt, contacts.gravity};
  const double size = kAlike * m_seen.sum, reach = 0.5 * m_sections.length;
  const bool isAlike = now.gravity == m_seen.gravity && std::abs(now.sum - m_seen.sum) <= size &&
                       (now.first - m_seen.first).cwiseAbs().maxCoeff() <= size * reach &&
                       (now.second - m_seen.second).cwiseAbs().maxCoeff() <= size * reach * reach;
  if (!isAlike) m_seen = now;
  m_settling = isAlike && spin < kTurns ? m_settling + dt : 0;
  return m_settling > kSettled && m_share < kFar;
}

void LoadGauge::reset() {
  m_seen = {};
  m_settling = 0;
  m_loads.fill({});
  m_bearing = m_share = 0;
}

void LoadGauge::note(const RestingLoad& load, double dt) {
  Wrench contacts;
  double bearing = 0;
  for (const ContactPatch& patch : load.contacts) {
    contacts += patch.load;
    const double h = m_sections.spacing;
    bearing = std::max(bearing, patch.press / (patch.area + h * patch.halfRim + h * h));
  }
  LinearField onMass, onAnchors;
  if (load.held) {
    onMass.offset = load.gravity;
    Wrench all = m_sections.mass.under(onMass);
    all += contacts;
    onAnchors = reactionField(m_sections.anchors, all);
  } else {
    onMass = inertialField(m_sections.mass, contacts, load.spin);
  }
  const double fresh = -std::expm1(-dt / kSmoothing);
  m_bearing += fresh * (bearing - m_bearing);
  m_share = m_bearing / m_compression;
  for (std::size_t c = 0; c < kCuts; ++c) {
    const Section& cut = m_sections.cuts[c];
    Wrench now = cut.mass.under(onMass);
    now += cut.anchors.under(onAnchors);
    for (const ContactPatch& patch : load.contacts) now += patch.beyond(cut);
    m_loads[c].force += fresh * (now.force - m_loads[c].force);
    m_loads[c].moment += fresh * (now.moment - m_loads[c].moment);
    m_share = std::max(m_share, sectionShare(cut, m_loads[c]));
  }
}

// Stresses on the cut's surface, and how near they are to the strength by the law of the springs
// (edem/criterion.h): bending opens it at its pulled edge, pressure is judged by its mean.
double LoadGauge::sectionShare(const Section& cut, const Wrench& load) const {
  if (!(cut.area > 0)) return 0;
  const Eigen::Vector3d moment = load.moment - cut.centroid.cross(load.force);
  const double pull = load.force[cut.axis], twist = moment[cut.axis];
  const double u = moment[(cut.axis + 1) % 3], v = moment[(cut.axis + 2) % 3];
  const double shearForce = std::hypot(load.force[(cut.axis + 1) % 3], load.force[(cut.axis + 2) % 3]);
  // sigma = N / A + a u + b v with the moments u = int sigma v, v = -int sigma u.
  const double determinant = cut.uu * cut.vv - cut.uv * cut.uv;
  const Eigen::Vector2d slope((-v * cut.vv - u * cut.uv) / determinant,
                              (u * cut.uu + v * cut.uv) / determinant);
  double bending = 0;
  for (const Eigen::Vector2d& point : cut.rim) bending = std::max(bending, slope.dot(point));
  const double normal = pull / cut.area;
  const double shear = shearForce / cut.area + std::abs(twist) / cut.twist;
  return std::max({(normal + bending) / m_tension, -normal / m_compression,
                   shear / (m_cohesion + m_friction * std::max(0.0, -normal))});
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
