#include "bullet/ledger_book.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

void LedgerBook::addExchange(const debris::Exchange& exchange) {
  m_gravity += exchange.gravity;
  m_air += exchange.air;
  m_contact += exchange.contact;
  m_removed += exchange.removed;
  m_surfaceWork += exchange.workOnSurfaces;
  m_ledger.placed += exchange.placed;
  m_impulseSizes +=
      exchange.gravity.linear.norm() + exchange.air.linear.norm() + exchange.contact.linear.norm();
}

void LedgerBook::addPush(const ElementPush& push) {
  m_push.given += push.given;
  m_push.received += push.received;
}

void LedgerBook::addMade(double energy, std::uint32_t bodies) {
  m_ledger.made = energy;
  m_ledger.makers = bodies;
}

// Whoever stands is pushed by its weight and by the ground for ever, so a sum of all pushes would allow more
// error the longer things stand. The largest there ever was does not: sum m |v| <= sqrt(2 m E), by Cauchy's
// inequality, and the pushes of one tick, which are all there is where nothing moves.
double LedgerBook::momentumScale(const edem::Books& books, const debris::Motion& debris) {
  const auto most = [](double mass, double kinetic) { return std::sqrt(2 * mass * std::max(kinetic, 0.0)); };
  const double size = books.bullet.size + books.gravity.size + books.anchors.size + m_impulseSizes;
  m_largestExchange = std::max(m_largestExchange, size - std::exchange(m_exchangedSize, size));
  m_largestMomentum =
      std::max(m_largestMomentum, most(books.mass, books.kinetic) + most(debris.mass, debris.kinetic));
  return std::max(1e-6, m_largestMomentum + m_largestExchange);
}

void LedgerBook::close(const edem::Books& books, const debris::Motion& debris) {
  Ledger& l = m_ledger;
  l.massElements = books.mass;
  l.massDebris = debris.mass;
  l.massDustEmitted = m_dust.mass;
  l.massRemoved = m_removed.mass;
  const double mass = l.massElements + l.massDebris + l.massDustEmitted + l.massRemoved;
  l.massError = books.initialMass > 0 ? std::abs(mass - books.initialMass) / books.initialMass : 0;

  // Momentum: what is there, and what left, is what was there and what was exchanged (law 12).
  l.linearMomentum = books.linear + debris.linear;
  l.angularMomentum = books.angular + debris.angularAbout(books.centre);
  // What debris give to elements stays among them: it is taken out of both sides' exchange.
  const Eigen::Vector3d linear = books.initialLinear + books.bullet.linear - m_push.received.linear +
                                 books.gravity.linear + books.anchors.linear + m_gravity.linear +
                                 m_air.linear + m_contact.linear + m_push.given.linear - books.sleptLinear -
                                 m_dust.linear - m_removed.linear;
  const Eigen::Vector3d angular =
      books.initialAngular + books.bullet.angular - m_push.received.angular + books.gravity.angular +
      books.anchors.angular + m_gravity.angularAbout(books.centre) + m_air.angularAbout(books.centre) +
      m_contact.angularAbout(books.centre) + m_push.given.angularAbout(books.centre) - books.sleptAngular -
      m_dust.angularAbout(books.centre) - m_removed.angularAbout(books.centre);
  const double scale = l.momentumScale = momentumScale(books, debris);
  l.linearError = (l.linearMomentum - linear).norm() / scale;
  l.angularError = (l.angularMomentum - angular).norm() / (scale * std::max(books.diagonal, 1e-6));

  l.kinetic = books.kinetic;
  l.elastic = books.elastic;
  l.debris = debris.kinetic;
  l.gravity = books.gravity.work.done() + m_gravity.energy;
  l.exchanged = books.bullet.work.done() + books.anchors.work.done() - m_push.received.energy -
                (m_surfaceWork - m_push.given.energy);
  l.dissipated = -books.dissipated.done() + books.massDamped - m_air.energy - m_contact.energy -
                 m_surfaceWork + l.placed;
  m_lostByElements = -books.dissipated.done() + books.massDamped + books.fracture + books.slept;
  l.fracture = books.fracture - m_given;
  l.removed = books.slept + m_dust.kinetic + m_removed.kinetic;
  m_largestEnergy =
      std::max({m_largestEnergy, 1e-6, l.kinetic + l.elastic + std::abs(l.exchanged) + std::abs(l.gravity)});
  l.energyScale = m_largestEnergy;
  const double held = l.kinetic + l.elastic + l.debris + l.dissipated + l.fracture + l.removed;
  l.energyError = std::abs(held - books.initialEnergy - l.gravity - l.exchanged - l.placed) / m_largestEnergy;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
