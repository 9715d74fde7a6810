#include "cook/spread.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "cook/random.h"
#include "cook/surface_samples.h"

namespace rubble::cooking {
namespace {

constexpr std::size_t kInVolume = 3;      // candidates for each element
constexpr std::size_t kVolumeTries = 64;  // random places for each element, in search of those
constexpr std::size_t kLeastOnSurface = 4;
constexpr std::size_t kMostOnSurface = 16;
constexpr double kOnSpacing = 6;     // candidates on each squared spacing of the surface
constexpr int kBisections = 16;      // of the distance, in powers
constexpr double kCloser = 0.9;      // by which the distance shrinks for the last elements
constexpr double kSamePlace = 1e-9;  // [spacing] candidates no farther apart are one

// Shares of the time when candidates from the volume and then those from the surface are there, as measured
// in shells; the rest throws darts.
constexpr double kVolumeDone = 0.4;
constexpr double kSurfaceDone = 0.9;

// Which of the candidates thrown so far are near: a uniform grid with a list in each cell.
class DartBoard {
 public:
  DartBoard(const std::vector<Room>& candidates, const Eigen::AlignedBox3d& bounds, double distance)
      : m_candidates(candidates), m_origin(bounds.min()), m_distance(distance) {
    // Cells no narrower than the distance, and about as many as candidates.
    const double most = 4.0 * double(candidates.size()) + 4096;
    constexpr double kWiden = 1.2;
    // From a distance of nothing no widening would lead to few enough.
    double size = std::max(distance, bounds.sizes().maxCoeff() / most);
    const auto cells = [&](double s) { return (bounds.sizes() / s).array().ceil().max(1.0).prod(); };
    while (cells(size) > most) size *= kWiden;
    m_scale = 1 / size;
    for (std::size_t axis = 0; axis < 3; ++axis)
      m_cells[axis] = std::max(1, int(std::ceil(bounds.sizes()[Eigen::Index(axis)] / size)));
    m_first.assign(std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]), kNoElement);
    m_next.resize(candidates.size());
  }

  void setDistance(double distance) { m_distance = distance; }  // to a shorter one

  bool isFree(std::uint32_t candidate) const {
    const Eigen::Vector3d& place = m_candidates[candidate].place;
    const std::array<int, 3> cell = cellAt(place);
    for (int z = std::max(0, cell[2] - 1); z <= std::min(m_cells[2] - 1, cell[2] + 1); ++z)
      for (int y = std::max(0, cell[1] - 1); y <= std::min(m_cells[1] - 1, cell[1] + 1); ++y)
        for (int x = std::max(0, cell[0] - 1); x <= std::min(m_cells[0] - 1, cell[0] + 1); ++x)
          for (std::uint32_t other = m_first[index({x, y, z})]; other != kNoElement; other = m_next[other])
            if ((m_candidates[other].place - place).squaredNorm() < m_distance * m_distance) return false;
    return true;
  }

  void take(std::uint32_t candidate) {
    std::uint32_t& first = m_first[index(cellAt(m_candidates[candidate].place))];
    m_next[candidate] = first;
    first = candidate;
  }

 private:
  std::array<int, 3> cellAt(const Eigen::Vector3d& place) const {
    std::array<int, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = Eigen::Index(axis);
      cell[axis] = int(std::clamp((place[a] - m_origin[a]) * m_scale, 0.0, double(m_cells[axis] - 1)));
    }
    return cell;
  }
  std::size_t index(const std::array<int, 3>& cell) const {
    return std::size_t(cell[0]) +
           std::size_t(m_cells[0]) * (std::size_t(cell[1]) + std::size_t(m_cells[1]) * std::size_t(cell[2]));
  }

  const std::vector<Room>& m_candidates;
  const Eigen::Vector3d m_origin;
  double m_distance, m_scale = 1;
  std::array<int, 3> m_cells{};
  std::vector<std::uint32_t> m_first, m_next;
};

class Spread {
 public:
  Spread(const SignedDistance& distance, const CheckedMesh& mesh, const SpreadDef& def,
         const std::function<void(double)>& progress)
      : m_distance(distance), m_mesh(mesh), m_def(def), m_progress(progress), m_random(def.seed) {}

  std::vector<Room> run() {
    addFromVolume();
    addFromSurface();
    shuffle();
    // The shortest distance at which no more remain than wanted, to a few per cent.
    double tooMany = m_def.spacing / 4;
    double fewEnough = m_mesh.diagonal();
    while (throwDarts(tooMany).size() < m_def.count) {
      tooMany /= 4;
      if (tooMany < kSamePlace * m_def.spacing) refuse();
    }
    for (int k = 0; k < kBisections; ++k) {
      m_progress(kSurfaceDone + (1 - kSurfaceDone) * k / kBisections);
      const double middle = std::sqrt(tooMany * fewEnough);
      (throwDarts(middle).size() > m_def.count ? tooMany : fewEnough) = middle;
    }
    std::vector<Room> places;
    for (const std::uint32_t c : fill(fewEnough)) places.push_back(m_candidates[c]);
    return places;
  }

 private:
  void addFromVolume() {
    const Eigen::AlignedBox3d& box = m_mesh.bounds;
    const std::size_t wanted = kInVolume * m_def.count;
    const std::size_t tries = kVolumeTries * m_def.count;
    for (std::size_t k = 0; k < tries && m_candidates.size() < wanted; ++k) {
      m_progress(kVolumeDone *
                 std::max(double(k) / double(tries), double(m_candidates.size()) / double(wanted)));
      Eigen::Vector3d place;
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = box.min()[axis] + m_random.uniform() * box.sizes()[axis];
      const double value = m_distance.fast(place).value;
      if (value + 2 * m_distance.fastError() <= -m_def.radius) {
        m_candidates.push_back({place, m_def.radius});
      } else if (value <= 0 && m_distance.exact(place).value < 0) {
        m_candidates.push_back(findRoomNear(m_distance, place, m_def.radius));
      }
    }
  }

  void addFromSurface() {
    const double wanted = kOnSpacing * surfaceArea(m_mesh) / (m_def.spacing * m_def.spacing);
    const std::size_t count = std::size_t(
        std::clamp(wanted, double(kLeastOnSurface * m_def.count), double(kMostOnSurface * m_def.count)));
    std::size_t done = 0;
    for (const auto& [place, triangle] : sampleSurface(m_mesh, count, m_random)) {
      m_progress(kVolumeDone + (kSurfaceDone - kVolumeDone) * double(done++) / double(count));
      // A little below, where the distance knows which way is in.
      constexpr double kBelow = 1e-3;
      const Room room =
          findRoomNear(m_distance, place - kBelow * m_def.radius * m_mesh.normals[triangle], m_def.radius);
      if (room.depth > 0) m_candidates.push_back(room);
    }
  }

  void shuffle() {
    for (std::size_t left = m_candidates.size(); left > 1; --left)
      std::swap(m_candidates[left - 1], m_candidates[std::size_t(m_random.uniform() * double(left))]);
  }

  std::vector<std::uint32_t> throwDarts(double distance) const {
    DartBoard board(m_candidates, m_mesh.bounds, distance);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t c = 0; c < m_candidates.size(); ++c) {
      if (!board.isFree(c)) continue;
      board.take(c);
      taken.push_back(c);
    }
    return taken;
  }

  // There are several candidates for each element, unless the surface leaves no inside.
  [[noreturn]] void refuse() const {
    throw Error("mesh: only " + std::to_string(m_candidates.size()) + " places inside were found for " +
                std::to_string(m_def.count) +
                " elements: two sheets of its surface probably lie in the same place; allowed are closed "
                "surfaces with an inside");
  }

  // Goes on with shorter distances until there are as many as wanted.
  std::vector<std::uint32_t> fill(double distance) const {
    DartBoard board(m_candidates, m_mesh.bounds, distance);
    std::vector<std::uint32_t> taken;
    std::vector<bool> isTaken(m_candidates.size(), false);
    for (; taken.size() < m_def.count; distance *= kCloser) {
      board.setDistance(distance);
      for (std::uint32_t c = 0; c < m_candidates.size() && taken.size() < m_def.count; ++c) {
        if (isTaken[c] || !board.isFree(c)) continue;
        board.take(c);
        isTaken[c] = true;
        taken.push_back(c);
      }
    }
    return taken;
  }

  const SignedDistance& m_distance;
  const CheckedMesh& m_mesh;
  const SpreadDef m_def;
  const std::function<void(double)>& m_progress;
  Random m_random;
  std::vector<Room> m_candidates;
};

}  // namespace

std::vector<Room> spread(const SignedDistance& distance, const CheckedMesh& mesh, const SpreadDef& def,
                         const std::function<void(double)>& progress) {
  assert(def.count > 0 && def.radius > 0 && def.spacing > 0);
  return Spread(distance, mesh, def, progress).run();
}

}  // namespace rubble::cooking
