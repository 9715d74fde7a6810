#include "cook/packing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "cook/random.h"

namespace rubble::cooking {
namespace {

constexpr double kMoveShare = 0.35;    // of each overlap taken back per iteration; both partners move
constexpr double kLargestMove = 0.5;   // [r] per iteration
constexpr int kProjections = 4;        // three faces may meet in a corner, and curved ones need one more
constexpr int kPolishIterations = 30;  // with exact distances, after the fast ones
constexpr double kStuck = 0.05;        // [r] a centre pressed out this far sits where no sphere fits
constexpr int kRestartPeriod = 50;     // iterations between the checks for stuck centres
constexpr int kBlindTries = 64;        // random places before a random place is pushed inside
constexpr int kTries = 20000;          // for one element, before giving up
constexpr int kTriesEach = 256;        // for all elements together, on average
constexpr int kClimbs = 255;           // for the depth of the solid, where elements found no room
constexpr int kClimbTries = 40;        // steps of one of them; halved so often a step is nothing
constexpr double kStartShare = 0.5;    // of the time, of a start at random
constexpr double kPolishShare = 0.1;
constexpr double kFits = 1e-6;  // [r] tolerance of "a sphere fits here"

// A uniform grid over the centres, and the overlaps found with it.
class ContactGrid {
 public:
  ContactGrid(const Eigen::AlignedBox3d& bounds, double diameter, std::size_t count)
      : m_origin(bounds.min()) {
    // Cells as wide as a diameter, unless the solid fills so little of its bounds that there would be too
    // many.
    const double mostCells = 8.0 * double(count) + 4096;
    double size = diameter;
    const auto cells = [&](double s) { return (bounds.sizes() / s).array().ceil().max(1.0).prod(); };
    constexpr double kWiden = 1.2;
    while (cells(size) > mostCells) size *= kWiden;
    m_scale = 1 / size;
    for (std::size_t axis = 0; axis < 3; ++axis)
      m_cells[axis] = std::max(1, int(std::ceil(bounds.sizes()[Eigen::Index(axis)] / size)));
    m_start.resize(std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]) + 1);
    m_cellOf.resize(count);
    m_order.resize(count);
    m_sorted.resize(count);
  }

  // Calls visit(a, b) once for each pair of elements in the same or in neighbouring cells.
  template <class Visit>
  void visitPairs(const std::vector<Eigen::Vector3d>& centres, Visit&& visit) {
    sort(centres);
    for (std::uint32_t s = 0; s < m_order.size(); ++s) {
      const std::size_t cell = m_cellOf[m_order[s]];
      const int x = int(cell % std::size_t(m_cells[0]));
      const int y = int(cell / std::size_t(m_cells[0]) % std::size_t(m_cells[1]));
      const int z = int(cell / std::size_t(m_cells[0]) / std::size_t(m_cells[1]));
      visitRow(s, s + 1, x + 1, y, z, visit);  // of its own row only what comes after it
      visitRow(s, rowStart(x - 1, y + 1, z), x + 1, y + 1, z, visit);
      for (int dy = -1; dy <= 1; ++dy)
        visitRow(s, rowStart(x - 1, y + dy, z + 1), x + 1, y + dy, z + 1, visit);
    }
  }

 private:
  std::size_t index(int x, int y, int z) const {
    return std::size_t(x) +
           std::size_t(m_cells[0]) * (std::size_t(y) + std::size_t(m_cells[1]) * std::size_t(z));
  }

  std::size_t cellAt(const Eigen::Vector3d& place) const {
    std::array<int, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = Eigen::Index(axis);
      const double scaled = (place[a] - m_origin[a]) * m_scale;
      cell[axis] = int(std::clamp(scaled, 0.0, double(m_cells[axis] - 1)));
    }
    return index(cell[0], cell[1], cell[2]);
  }

  // Counting sort: elements of a row of cells end up side by side, in the order of their indices within a
  // cell.
  void sort(const std::vector<Eigen::Vector3d>& centres) {
    std::fill(m_start.begin(), m_start.end(), 0u);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      m_cellOf[i] = cellAt(centres[i]);
      ++m_start[m_cellOf[i] + 1];
    }
    for (std::size_t c = 1; c < m_start.size(); ++c) m_start[c] += m_start[c - 1];
    m_cursor.assign(m_start.begin(), m_start.end() - 1);
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
      const std::uint32_t at = m_cursor[m_cellOf[i]]++;
      m_order[at] = i;
      m_sorted[at] = centres[i];
    }
  }

  bool hasRow(int y, int z) const { return y >= 0 && y < m_cells[1] && z < m_cells[2]; }

  std::uint32_t rowStart(int x, int y, int z) const {
    return hasRow(y, z) ? m_start[index(std::max(x, 0), y, z)] : 0;
  }

  // The sorted elements from `first` to the end of cell (x, y, z).
  template <class Visit>
  void visitRow(std::uint32_t s, std::uint32_t first, int x, int y, int z, Visit& visit) {
    if (!hasRow(y, z)) return;
    const std::uint32_t end = m_start[index(std::min(x, m_cells[0] - 1), y, z) + 1];
    for (std::uint32_t other = first; other < end; ++other)
      visit(m_order[s], m_order[other], m_sorted[s], m_sorted[other]);
  }

  Eigen::Vector3d m_origin;
  double m_scale = 1;
  std::array<int, 3> m_cells{};
  std::vector<std::uint32_t> m_start, m_cursor, m_order;
  std::vector<std::size_t> m_cellOf;
  std::vector<Eigen::Vector3d> m_sorted;
};

class Relaxation {
 public:
  Relaxation(const SignedDistance& distance, const Eigen::AlignedBox3d& bounds, const PackingDef& def)
      : m_distance(distance),
        m_bounds(bounds),
        m_def(def),
        m_random(def.seed),
        m_grid(bounds, 2 * def.radius, def.count),
        m_moves(def.count),
        m_protrusion(def.count, 0.0) {
    m_packing.rooms.assign(def.count, def.radius);
  }

  Packing run(const std::function<void(double)>& progress) {
    m_triesLeft = kTries + kTriesEach * std::int64_t(m_def.count);
    if (!start(progress)) {
      climb();
      return std::move(m_packing);
    }
    const double started = m_def.start.empty() ? kStartShare : 0;
    for (int& iteration = m_packing.iterations;; ++iteration) {
      m_packing.deepestOverlap = findOverlaps();
      if (m_packing.deepestOverlap <= m_def.maxOverlap || iteration >= m_def.maxIterations) break;
      applyMoves();
      project(false);
      if (iteration % kRestartPeriod == kRestartPeriod - 1) restartStuck();
      progress(started + (1 - kPolishShare - started) * iteration / m_def.maxIterations);
    }
    if (m_distance.fastError() > 0) polish(progress);
    m_packing.deepestProtrusion = *std::max_element(m_protrusion.begin(), m_protrusion.end());
    return std::move(m_packing);
  }

 private:
  bool start(const std::function<void(double)>& progress) {
    for (std::size_t i = 0; i < m_def.start.size(); ++i) {
      m_packing.centres.push_back(m_def.start[i].place);
      m_packing.rooms[i] = m_def.start[i].depth;
    }
    if (!m_def.start.empty()) return true;
    for (std::size_t i = 0; i < m_def.count; ++i) {
      progress(kStartShare * double(i) / double(m_def.count));
      Eigen::Vector3d place;
      if (!findRoom(place)) return false;
      m_packing.centres.push_back(place);
    }
    return true;
  }

  // A random place where a sphere fits. In thin walls hardly any place will do, so random ones are pushed
  // inside then.
  bool findRoom(Eigen::Vector3d& place) {
    for (int tries = 0; tries < kTries && m_triesLeft > 0; ++tries, --m_triesLeft) {
      place = randomPlace();
      // Walls hardly thicker than a sphere need the exact distance: interpolated, it is cut off at their
      // middle.
      const bool isPushed = tries >= kBlindTries;
      if (isPushed) pushInside(place, m_def.radius, true);
      const double depth = -measure(place, isPushed).value;
      m_packing.deepestPlace = std::max(m_packing.deepestPlace, depth);
      if (depth >= (1 - kFits) * m_def.radius) return true;
    }
    return false;
  }

  // Measures how deep the solid is: from places all over the surface inwards, uphill, in steps that shorten
  // where they lead down again.
  void climb() {
    std::vector<double> depths;
    for (int k = 0; k < kClimbs; ++k) {
      Eigen::Vector3d place = randomPlace();
      Distance here = m_distance.exact(place);
      place -= here.value * here.gradient;
      here.value = 0;
      double step = m_def.radius;
      for (int tries = 0; tries < kClimbTries; ++tries) {
        const Eigen::Vector3d next = place - step * here.gradient;
        const Distance there = m_distance.exact(next);
        if (there.value < here.value) {
          place = next;
          here = there;
        } else {
          step /= 2;
        }
      }
      depths.push_back(-here.value);
    }
    std::sort(depths.begin(), depths.end());
    m_packing.usualDepth = depths[depths.size() / 2];
    m_packing.deepestPlace = std::max(m_packing.deepestPlace, depths.back());
  }

  Eigen::Vector3d randomPlace() {
    Eigen::Vector3d place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = m_bounds.min()[axis] + m_random.uniform() * m_bounds.sizes()[axis];
    return place;
  }

  // Moves the centre until it is `room` below the surface; returns by how much it still is not [m].
  double pushInside(Eigen::Vector3d& centre, double room, bool isExact) const {
    for (int k = 0; k < kProjections; ++k) {
      const Distance distance = measure(centre, isExact);
      const double protrusion = distance.value + room;
      if (protrusion <= 0) return 0;
      centre -= protrusion * distance.gradient;
    }
    return std::max(0.0, measure(centre, isExact).value + room);
  }

  Distance measure(const Eigen::Vector3d& centre, bool isExact) const {
    const Distance distance = m_distance.fast(centre);
    const bool isNear = distance.value + 2 * m_distance.fastError() > -m_def.radius;
    return isExact && isNear ? m_distance.exact(centre) : distance;
  }

  // Fills m_moves; returns the deepest overlap [2 r].
  double findOverlaps() {
    const double diameter = 2 * m_def.radius;
    double deepest = 0;
    std::fill(m_moves.begin(), m_moves.end(), Eigen::Vector3d::Zero());
    m_grid.visitPairs(m_packing.centres, [&](std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& placeA,
                                             const Eigen::Vector3d& placeB) {
      const Eigen::Vector3d between = placeB - placeA;
      const double squared = between.squaredNorm();
      if (squared >= diameter * diameter) return;
      const double length = std::sqrt(squared);
      const double overlap = diameter - length;
      deepest = std::max(deepest, overlap);
      const Eigen::Vector3d direction = length > 0 ? Eigen::Vector3d(between / length) : someDirection(a, b);
      m_moves[a] -= kMoveShare * overlap * direction;
      m_moves[b] += kMoveShare * overlap * direction;
    });
    return deepest / diameter;
  }

  // For two centres in one place.
  static Eigen::Vector3d someDirection(std::uint32_t a, std::uint32_t b) {
    Random random((std::uint64_t{a} << 32) | b);
    Eigen::Vector3d direction;
    for (int axis = 0; axis < 3; ++axis) direction[axis] = random.uniform() - 0.5;
    return direction.normalized();
  }

  void applyMoves() {
    const double largest = kLargestMove * m_def.radius;
    for (std::size_t i = 0; i < m_moves.size(); ++i) {
      const double length = m_moves[i].norm();
      m_packing.centres[i] +=
          length > largest ? Eigen::Vector3d(m_moves[i] * (largest / length)) : m_moves[i];
    }
  }

  void project(bool isExact) {
    for (std::size_t i = 0; i < m_def.count; ++i)
      m_protrusion[i] = pushInside(m_packing.centres[i], m_packing.rooms[i],
                                   // in walls thinner than the sphere the fast distance sees no inside
                                   isExact || m_packing.rooms[i] < m_def.radius);
  }

  // Contacts may press a centre into a tip too narrow for it. It starts again elsewhere; where elements were
  // given their places, it takes what room there is.
  void restartStuck() {
    for (std::size_t i = 0; i < m_def.count; ++i) {
      if (m_protrusion[i] <= kStuck * m_def.radius) continue;
      if (m_def.start.empty()) {
        findRoom(m_packing.centres[i]);
      } else {
        const Room room = findRoomNear(m_distance, m_packing.centres[i], m_def.radius);
        m_packing.centres[i] = room.place;
        m_packing.rooms[i] = room.depth;
      }
    }
  }

  // The fast distance is off near edges of the surface; what it left there is mended with the exact one.
  void polish(const std::function<void(double)>& progress) {
    project(true);
    for (int k = 0;; ++k) {
      progress(1 - kPolishShare + kPolishShare * k / kPolishIterations);
      m_packing.deepestOverlap = findOverlaps();
      if (m_packing.deepestOverlap <= m_def.maxOverlap || k >= kPolishIterations) break;
      applyMoves();
      project(true);
    }
  }

  const SignedDistance& m_distance;
  const Eigen::AlignedBox3d m_bounds;
  const PackingDef m_def;
  Random m_random;
  std::int64_t m_triesLeft = 0;
  ContactGrid m_grid;
  Packing m_packing;
  std::vector<Eigen::Vector3d> m_moves;
  std::vector<double> m_protrusion;  // [m]
};

}  // namespace

Packing pack(const SignedDistance& distance, const Eigen::AlignedBox3d& bounds, const PackingDef& def,
             const std::function<void(double)>& progress) {
  assert(def.count > 0 && def.radius > 0 && def.maxOverlap >= 0 && def.maxIterations >= 0);
  assert(!bounds.isEmpty() && (def.start.empty() || def.start.size() == def.count));
  return Relaxation(distance, bounds, def).run(progress);
}

}  // namespace rubble::cooking
