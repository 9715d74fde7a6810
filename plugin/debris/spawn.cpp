#include "debris/spawn.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/number_text.h"
#include "debris/swarm.h"
#include "rubble/error.h"

namespace rubble::debris {

namespace {

// Places of the pieces: half way from the centre to the face's centroid (law 9).
constexpr double kPlace = 0.5;
// The pieces' own inertia is at least this share of the element's or of their places': spin = momentum /
// inertia must stay well posed for cells whose places hold all of the inertia.
constexpr double kLeastInertia = 1e-3;

void requireAboveZero(double value, double most, const char* name) {
  if (value > 0 && value <= most) return;
  throw Error(std::string("debris: ") + name + " is " + base::numberText(value) +
              ", must be above 0 and at most " + base::numberText(most));
}

void requireAtLeastZero(double value, double most, const char* name) {
  if (value >= 0 && value <= most) return;
  throw Error(std::string("debris: ") + name + " is " + base::numberText(value) + ", must be 0 to " +
              base::numberText(most));
}

void requireUsable(const Eigen::Vector3d& value, const char* name) {
  if (!isUsable(value)) throw Error(std::string("debris: ") + name + " is not finite, or larger than 1e12");
}

void validate(const base::CrushedElement& element, std::span<const CellFace> faces) {
  requireAboveZero(element.mass, kLargestAmount, "mass of the element");
  requireAtLeastZero(element.inertia, kLargestAmount, "inertia of the element");
  requireAboveZero(element.volume, kLargestAmount, "volume of the cell");
  requireAboveZero(element.radius, kLargest, "radius of the element");
  requireAtLeastZero(element.releasedEnergy, kLargestAmount, "energy released");
  requireUsable(element.restCentre, "rest place of the element");
  requireUsable(element.centre, "place of the element");
  requireUsable(element.velocity, "velocity of the element");
  requireUsable(element.spin, "spin of the element");
  if (!(std::abs(element.orientation.norm() - 1) < 1e-3))
    throw Error("debris: orientation of the element is not a unit quaternion");
  for (const CellFace& face : faces) {
    requireUsable(face.normal.cast<double>(), "normal of a cell's face");
    requireUsable(face.centroid.cast<double>(), "centroid of a cell's face");
  }
}

Motion scaled(const Motion& motion, double share) {
  return {share * motion.mass, share * motion.linear, share * motion.angular, share * motion.kinetic};
}

// Angular velocity of the places. It is the element's own, unless their moment about an axis is larger than
// the element's: then it is less, or they would have more angular momentum and energy than the element had.
Eigen::Vector3d orbitRate(const PrincipalInertia& places, double inertia, const Eigen::Vector3d& spin) {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d direction = places.axes.col(axis);
    const double moment = places.moments[axis];
    const double share = moment > inertia ? inertia / moment : 1;
    rate += direction * (share * direction.dot(spin));
  }
  return rate;
}

}  // namespace

Spawner::Spawner(const Material& material, const Model& model, std::uint64_t seed)
    : m_material(material), m_model(model), m_seed(seed) {
  requireAboveZero(material.density, kLargest, "density");
  requireAtLeastZero(material.friction, kLargest, "friction");
  requireAtLeastZero(material.debrisSpeed, kLargest, "debrisSpeed");
  validate(SizeLaw{0, material.dustRadius, material.sizeModulus});
}

void Spawner::reserve(std::size_t faces, DebrisBatch& batch) {
  batch.pieces.reserve(faces);
  m_sizes.reserve(faces);
  m_masses.reserve(faces);
  m_offsets.reserve(faces);
  m_velocities.reserve(faces);
}

void Spawner::spawn(const base::CrushedElement& element, std::span<const CellFace> faces,
                    DebrisBatch& batch) {
  validate(element, faces);
  makePieces(element, faces, batch);
  if (m_model.conserveDebris)
    scatterConserving(element, batch);
  else
    scatterFromCentre(element, batch);

  batch.piecesMotion = {};
  for (const DebrisParcel& p : batch.pieces)
    batch.piecesMotion += motionOf(p.mass, p.inertia, p.position, p.velocity, p.spin);
  const Motion whole =
      motionOf(element.mass, element.inertia, element.centre, element.velocity, element.spin);
  batch.dustMotion = scaled(whole, batch.dustShare);
  batch.energyGiven = batch.piecesMotion.kinetic + batch.dustMotion.kinetic - whole.kinetic;
}

// Sizes, masses, places and scattering directions: all that both readings of the paper share.
void Spawner::makePieces(const base::CrushedElement& element, std::span<const CellFace> faces,
                         DebrisBatch& batch) {
  const SizeLaw law{element.maxRadius, m_material.dustRadius, m_material.sizeModulus};
  const double u = sizeOffset(m_seed, element.body, element.element);
  m_sizes.resize(std::max<std::size_t>(faces.size(), 1));
  batch.dustShare = pieceSizes(law, m_model.debrisSizes, u, m_sizes);
  const std::size_t count = batch.dustShare < 1 ? m_sizes.size() : 0;
  batch.pieces.assign(count, {});
  m_masses.resize(count);
  m_offsets.assign(count, Eigen::Vector3d::Zero());
  m_velocities.assign(count, Eigen::Vector3d::Zero());

  const double speed = m_material.debrisSpeed * element.velocity.norm();
  const double cellRadius = std::cbrt(3 * element.volume / (4 * std::numbers::pi));
  const double drawn = m_model.conserveDebris ? cellRadius : 2 * element.radius;
  const Eigen::Matrix3d rotation = element.orientation.normalized().toRotationMatrix();
  for (std::size_t n = 0; n < count; ++n) {
    m_masses[n] = m_sizes[n].massShare * element.mass;
    if (n < faces.size()) {
      const Eigen::Vector3d arm = faces[n].centroid.cast<double>() - element.restCentre;
      m_offsets[n] = rotation * (kPlace * arm);
      m_velocities[n] = rotation * (speed * faces[n].normal.cast<double>().stableNormalized());
    }
    DebrisParcel& piece = batch.pieces[n];
    piece.orientation = element.orientation.normalized();
    piece.mass = m_masses[n];
    piece.radius = m_sizes[n].radius;
    piece.collisionRadius = m_model.conserveDebris ? piece.radius : 0;
    piece.density = m_material.density;
    piece.friction = m_material.friction;
    piece.scale = piece.radius / drawn;
    piece.body = element.body;
    piece.element = element.element;
  }
}

// Section 3.2 to the letter.
void Spawner::scatterFromCentre(const base::CrushedElement& element, DebrisBatch& batch) const {
  for (std::size_t n = 0; n < batch.pieces.size(); ++n) {
    batch.pieces[n].position = element.centre;
    batch.pieces[n].velocity = element.velocity + m_velocities[n];
  }
}

// DEVIATION: the pieces and the dust keep the element's momenta, and its kinetic energy but for what
// `releasedEnergy` adds. The motion is a rigid one, of energy E_rigid, plus scattering without linear or
// angular momentum, of energy E_s; the two are orthogonal, so the energies add up and E_s alone has to be
// scaled.
void Spawner::scatterConserving(const base::CrushedElement& element, DebrisBatch& batch) {
  if (batch.pieces.empty()) return;
  const double share = 1 - batch.dustShare;
  const double mass = share * element.mass;
  const double inertia = share * element.inertia;

  removeMean(m_masses, m_offsets);
  const PrincipalInertia places = principalInertia(m_masses, m_offsets);
  removeMean(m_masses, m_velocities);
  removeRotation(m_masses, m_offsets, places, m_velocities);

  // The pieces' own inertia is what their places leave of the element's about the axis that they fill least.
  // With more than that the spin has less energy, with less it could have more than the element's.
  const double leastInertia = kLeastInertia * std::max(inertia, places.moments[2]);
  const double ownInertia = std::max(inertia - places.moments[0], leastInertia);
  const Eigen::Vector3d rate = orbitRate(places, inertia, element.spin);
  const Eigen::Vector3d wanted = inertia * element.spin;
  const Eigen::Vector3d inPlaces = places.axes * places.moments.asDiagonal() * places.axes.transpose() * rate;
  const double spinEnergy = ownInertia > 0 ? 0.5 * (wanted - inPlaces).squaredNorm() / ownInertia : 0;
  const double slack = 0.5 * (wanted.dot(element.spin) - rate.dot(inPlaces)) - spinEnergy;  // >= 0
  const double scattering = kineticEnergy(m_masses, m_velocities);
  const double allowed = element.releasedEnergy + std::max(slack, 0.0);
  const double damping = scattering > allowed ? std::sqrt(allowed / scattering) : 1;
  for (std::size_t n = 0; n < m_velocities.size(); ++n)
    m_velocities[n] = damping * m_velocities[n] + rate.cross(m_offsets[n]);
  removeMean(m_masses, m_velocities);  // what rounding has left

  // The spin takes all that the places do not carry, rounding included.
  const Eigen::Vector3d left = wanted - angularMomentum(m_masses, m_offsets, m_velocities);
  const Eigen::Vector3d spin = ownInertia > 0 ? Eigen::Vector3d(left / ownInertia) : element.spin;
  for (std::size_t n = 0; n < batch.pieces.size(); ++n) {
    DebrisParcel& piece = batch.pieces[n];
    piece.position = element.centre + m_offsets[n];
    piece.offset = m_offsets[n];
    piece.velocity = element.velocity + m_velocities[n];
    piece.spin = spin;
    piece.inertia = ownInertia * piece.mass / mass;
  }
}

}  // namespace rubble::debris
