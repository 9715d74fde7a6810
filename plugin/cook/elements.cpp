#include "cook/elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cook/hilbert.h"
#include "cook/message.h"
#include "cook/random.h"
#include "cook/spread.h"
#include "cook/surface_samples.h"
#include "rubble/limits.h"

namespace rubble::cooking {
namespace {

// A chosen radius that does not fit shrinks by this much at a time, so often at most (down to 1.5 % of the
// first).
constexpr double kShrink = 0.9;
constexpr int kMostShrinks = 40;

// Evenly spread elements shrink until all but this share of them have room, but not below this share of the
// radius: spheres in a thick part would stand far apart for the sake of a thin one. Where most of the solid
// is thin, not below this share of the room that half of them have.
constexpr double kWithoutRoom = 0.005;
constexpr double kLeastRadius = 0.5;
constexpr double kLeastRoom = 0.8;

constexpr double kSpreadShare = 0.5;  // of an even filling's time

double ballVolume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double radiusForFill(double volume, double fill, std::size_t count) {
  return std::cbrt(fill * volume / double(count) * 3 / (4 * std::numbers::pi));
}

// The least room, but for this share of the elements.
double roomOfAllBut(double share, std::vector<double> rooms) {
  const auto least = rooms.begin() + std::ptrdiff_t(share * double(rooms.size()));
  std::nth_element(rooms.begin(), least, rooms.end());
  return *least;
}

}  // namespace

Packer::Packer(const CheckedMesh& mesh, const CookOptions& options, std::function<void(double)> progress)
    : m_mesh(mesh),
      m_options(options),
      m_isCountChosen(options.elements == 0),
      m_progress(std::move(progress)),
      m_distance(signedDistance(mesh)) {
  if (!m_isCountChosen) return;
  const double count = std::max(1.0, std::round(options.fill * mesh.volume / ballVolume(options.radius)));
  if (!limits::kElements.hold(count))
    throw Error(line("elements of radius ", options.radius, " m that fill ", options.fill, " of ",
                     mesh.volume, " m^3 are ", count, "; allowed: ", limits::kElements.text()));
  m_options.elements = std::size_t(count);
}

Elements Packer::fill() {
  if (m_options.radius > 0) return fillAsTold();
  double radius = wantedRadius();
  for (int shrinks = 0;; ++shrinks, radius *= kShrink) {
    Packing packing = packWith(radius, {});
    // Not the next radius for which the thickest corners of a thin solid alone have room.
    const bool hasRoom = packing.centres.size() == m_options.elements;
    for (; !hasRoom && shrinks + 1 < kMostShrinks && kShrink * radius > packing.usualDepth; ++shrinks)
      radius *= kShrink;
    const bool isLast = shrinks == kMostShrinks;
    if (!isLast && !fits(packing)) continue;
    requireFit(packing, radius);
    Elements elements = finish(std::move(packing), radius);
    if (shrinks > 0) noteShrink(LogLevel::Warning, radius, elements);
    return elements;
  }
}

Elements Packer::fillAsTold() {
  const double radius = m_options.radius;
  const double fill = double(m_options.elements) * ballVolume(radius) / m_mesh.volume;
  if (fill > 1) {
    throw Error(line(m_options.elements, " elements of radius ", radius, " m fill ", fill,
                     " times the mesh's volume of ", m_mesh.volume, " m^3; ", whatFits(radius)));
  }
  const std::size_t wanted = m_options.elements;
  Packing packing = packWith(radius, {});
  while (m_isCountChosen && m_options.elements > 1 && !fits(packing)) {
    m_options.elements = std::max<std::size_t>(1, std::size_t(kShrink * double(m_options.elements)));
    packing = packWith(radius, {});
  }
  requireFit(packing, radius);
  Elements elements = finish(std::move(packing), radius);
  if (m_options.elements < wanted)
    elements.notes.emplace_back(
        LogLevel::Warning, line(wanted, " elements of radius ", radius, " m, which fill ", m_options.fill,
                                " of the mesh, do not fit; ", m_options.elements, " taken, which fill ",
                                double(m_options.elements) * ballVolume(radius) / m_mesh.volume));
  return elements;
}

Elements Packer::fillEvenly() const {
  const bool isGiven = m_options.radius > 0;
  double radius = wantedRadius();
  for (int shrinks = 0;; ++shrinks, radius *= kShrink) {
    const std::vector<Room> start = startPlaces(radius);
    Packing packing = packWith(radius, start);
    if (!isGiven && shrinks < kMostShrinks && !fits(packing)) continue;
    requireFit(packing, radius);
    const double taken = isGiven ? radius : radiusInThinParts(packing.rooms, radius);
    for (std::size_t i = 0; i < packing.rooms.size(); ++i)
      packing.deepestProtrusion = std::max(packing.deepestProtrusion, taken - packing.rooms[i]);
    // Where most of the solid is thinner than they are, as many would not fit in any way.
    const bool isMuch =
        taken < kLeastRadius * wantedRadius() || roomOfAllBut(0.5, packing.rooms) < wantedRadius();
    Elements elements = finish(packing, taken);
    if (!isGiven && taken < wantedRadius())
      noteShrink(isMuch ? LogLevel::Warning : LogLevel::Info, taken, elements);
    return elements;
  }
}

double Packer::wantedRadius() const {
  return m_options.radius > 0 ? m_options.radius
                              : radiusForFill(m_mesh.volume, m_options.fill, m_options.elements);
}

std::vector<Room> Packer::startPlaces(double radius) const {
  m_distance->fitTo(radius);
  const double spacing = std::cbrt(m_mesh.volume / double(m_options.elements));
  return spread(*m_distance, m_mesh, {m_options.elements, radius, spacing, mix(m_options.seed)},
                [this](double share) { m_progress(kSpreadShare * share); });
}

double Packer::radiusInThinParts(const std::vector<double>& rooms, double radius) const {
  const double floor = std::min(kLeastRadius * radius, kLeastRoom * roomOfAllBut(0.5, rooms));
  return std::clamp(roomOfAllBut(kWithoutRoom, rooms), floor, radius);
}

Packing Packer::packWith(double radius, std::span<const Room> start) const {
  return packCount(m_options.elements, radius, start);
}

Packing Packer::packCount(std::size_t count, double radius, std::span<const Room> start) const {
  m_distance->fitTo(radius);
  const PackingDef def{count, radius, mix(m_options.seed), m_options.maxOverlap, m_options.maxIterations,
                       start};
  const double done = start.empty() ? 0 : kSpreadShare;
  return pack(*m_distance, m_mesh.bounds, def,
              [this, done](double share) { m_progress(done + (1 - done) * share); });
}

bool Packer::fits(const Packing& packing) const {
  return packing.centres.size() == m_options.elements && packing.deepestOverlap <= kDeepestOverlap;
}

void Packer::requireFit(const Packing& packing, double radius) const {
  if (packing.centres.size() < m_options.elements)
    throw Error(line("no sphere of radius ", radius, " m fits into the mesh: the deepest place found is ",
                     packing.deepestPlace, " m from its surface; ", whatFits(radius)));
  if (!fits(packing))
    throw Error(line(m_options.elements, " elements of radius ", radius,
                     " m do not fit: they overlap by up to ", 100 * packing.deepestOverlap,
                     " % of their diameter; ", whatFits(radius)));
}

bool Packer::doFit(std::size_t count, double radius) const {
  const Packing packing = packCount(count, radius, {});
  return packing.centres.size() == count && packing.deepestOverlap <= kDeepestOverlap;
}

// By trying, since the share that can be filled is 0.6 and more in a block and a third of it in thin walls.
// At most a tenth too few; 0: not one.
std::size_t Packer::mostThatFit(double radius) const {
  constexpr double kFirst = 0.55;
  constexpr double kFewer = 0.7;
  constexpr double kClose = 1.1;
  const double whole = m_mesh.volume / ballVolume(radius);
  std::size_t tooMany = std::min(m_options.elements, std::size_t(whole) + 2);
  std::size_t fitting = 0;
  std::size_t next = std::min(tooMany - 1, std::size_t(kFirst * whole) + 1);
  while (tooMany > fitting + 1 && double(tooMany) > kClose * double(fitting)) {
    (doFit(next, radius) ? fitting : tooMany) = next;
    next = fitting == 0 ? std::size_t(kFewer * double(tooMany))
                        : std::size_t(std::sqrt(double(fitting) * double(tooMany)));
    next = std::clamp(next, fitting + 1, std::max(fitting + 1, tooMany - 1));
  }
  return fitting;
}

std::string Packer::whatFits(double radius) const {
  double smaller = std::min(radius, radiusForFill(m_mesh.volume, m_options.fill, m_options.elements));
  for (int shrinks = 0; shrinks < kMostShrinks && !doFit(m_options.elements, smaller); ++shrinks)
    smaller *= kShrink;
  std::ostringstream text;
  const std::size_t most = mostThatFit(radius);
  if (most == 0) {
    text << "none of this radius fits";
  } else {
    text << "about " << most << " elements of this radius fit";
  }
  text << ", or a radius of about " << smaller << " m";
  return text.str();
}

Elements Packer::finish(Packing packing, double radius) const {
  Elements elements{radius, {}, {}};
  elements.notes.emplace_back(
      LogLevel::Info,
      line("packed ", packing.centres.size(), " elements of radius ", radius, " m in ", packing.iterations,
           " iterations, deepest overlap ", 100 * packing.deepestOverlap, " % of the diameter"));
  constexpr double kNoticed = 0.01;  // [r]
  if (packing.deepestProtrusion > kNoticed * radius)
    elements.notes.emplace_back(
        LogLevel::Warning, line("an element protrudes by ", packing.deepestProtrusion, " m from the mesh; ",
                                whatHolds(radius - packing.deepestProtrusion)));
  for (const std::uint32_t i : hilbertOrder(packing.centres)) elements.centres.push_back(packing.centres[i]);
  return elements;
}

std::string Packer::whatFills(double radius) const {
  const double count = std::ceil(m_options.fill * m_mesh.volume / ballVolume(radius));
  if (!limits::kElements.hold(count)) return "more elements than are allowed";
  std::ostringstream text;
  text << "about " << count << " elements";
  return text.str();
}

std::string Packer::whatHolds(double room) const {
  constexpr double kEdge = 0.05;  // [radius] less room is that of a sharp edge, which no sphere fills
  if (!(room > kEdge * wantedRadius())) return "in a sharp edge or a tip no radius would do";
  std::ostringstream text;
  text << room << " m as radius would do, or " << whatFills(room);
  return text.str();
}

void Packer::noteShrink(LogLevel level, double radius, Elements& elements) const {
  const double fill = double(m_options.elements) * ballVolume(radius) / m_mesh.volume;
  elements.notes.emplace_back(
      level, line("elements that fill ", m_options.fill, " of the mesh do not fit; radius ", radius,
                  " m taken, which fills ", fill, "; ", whatFills(radius), " would fill it"));
}

std::vector<std::pair<LogLevel, std::string>> Packer::foretell() const {
  constexpr std::size_t kSamples = 2000;
  const double radius = wantedRadius();
  Random random(mix(m_options.seed));
  std::vector<double> rooms;
  for (const SurfacePlace& place : sampleSurface(m_mesh, kSamples, random))
    rooms.push_back(findRoomNear(*m_distance, justBelow(place), radius, true).depth);
  const double room = roomOfAllBut(kWithoutRoom, rooms);
  constexpr double kNoticed = 0.98;
  if (room >= kNoticed * radius) return {};
  // Where the radius may be chosen it is chosen smaller, and only what is then left is worth a warning.
  const double taken = m_options.radius > 0 ? radius : radiusInThinParts(rooms, radius);
  const bool isMuch = room < kNoticed * taken || taken < kLeastRadius * radius;
  return {{isMuch ? LogLevel::Warning : LogLevel::Info,
           line("walls of about ", 2 * room, " m are thinner than the elements, whose radius would be ",
                radius, " m; ", room, " m as radius would do, or ", whatFills(room))}};
}

}  // namespace rubble::cooking
