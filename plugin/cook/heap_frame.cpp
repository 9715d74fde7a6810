#include "cook/heap_frame.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace rubble::cooking {
namespace {

// Coordinates nearer than this are one [share of the largest]: some hundred roundings.
constexpr double kSameCoordinate = 0x1p-44;
// Normals are one where they are as near; the sine between the directions taken [1].
constexpr double kSameNormal = 1e-6;
constexpr double kLeastTurn = 0.3;
// A frame other than the axes is taken where it has fewer coordinates than this share of theirs.
constexpr double kFewer = 0.9;

double largestOf(const std::vector<Eigen::Vector3d>& places) {
  double largest = 0;
  for (const Eigen::Vector3d& place : places) largest = std::max(largest, place.cwiseAbs().maxCoeff());
  return largest;
}

// Returns how many there are.
std::size_t joinCoordinates(std::vector<Eigen::Vector3d>& places) {
  const double near = kSameCoordinate * largestOf(places);
  std::size_t count = 0;
  std::vector<std::uint32_t> order(places.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return places[a][axis] < places[b][axis]; });
    double first = 0;
    for (std::size_t at = 0; at < order.size(); ++at) {
      double& own = places[order[at]][axis];
      if (at == 0 || own > first + near) {
        first = own;
        ++count;
      }
      own = first;
    }
  }
  return count;
}

struct Direction {
  Eigen::Vector3d normal;
  double area = 0, largest = 0;
};

std::vector<Direction> directionsOf(const Soup& soup) {
  std::map<std::array<long, 3>, Direction> byNormal;
  for (const auto& [a, b, c] : soup.triangles) {
    const Eigen::Vector3d& p = soup.vertices[a];
    Eigen::Vector3d normal = (soup.vertices[b] - p).cross(soup.vertices[c] - p);
    const double area = normal.norm();
    if (!(area > 0)) continue;
    normal /= area;
    Eigen::Index across = 0;
    normal.cwiseAbs().maxCoeff(&across);
    if (normal[across] < 0) normal = -normal;
    const Eigen::Vector3d key = (normal / kSameNormal).array().round();
    Direction& own = byNormal[{long(key.x()), long(key.y()), long(key.z())}];
    own.area += area;
    if (area > own.largest) own.normal = normal;
    own.largest = std::max(own.largest, area);
  }
  std::vector<Direction> directions;
  for (const auto& [key, direction] : byNormal) directions.push_back(direction);
  std::stable_sort(directions.begin(), directions.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  return directions;
}

// The axes where there are no three directions.
Eigen::Matrix3d mainNormals(const Soup& soup) {
  const std::vector<Direction> directions = directionsOf(soup);
  Eigen::Matrix3d normals = Eigen::Matrix3d::Identity();
  if (directions.empty()) return normals;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  normals.row(0) = directions[0].normal.transpose();
  for (const Direction& direction : directions) {
    const bool isSecond = across.isZero(0);
    if (isSecond) {
      const Eigen::Vector3d both = normals.row(0).transpose().cross(direction.normal);
      if (both.norm() < kLeastTurn) continue;
      across = both.normalized();
      normals.row(1) = direction.normal.transpose();
    } else if (const double turn = across.dot(direction.normal); std::abs(turn) >= kLeastTurn) {
      normals.row(2) = (turn > 0 ? 1 : -1) * direction.normal.transpose();
      return normals;
    }
  }
  return Eigen::Matrix3d::Identity();
}

}  // namespace

HeapFrame frameOf(const Soup& soup) {
  HeapFrame frame{soup.vertices, Eigen::Matrix3d::Identity()};
  const std::size_t along = joinCoordinates(frame.places);
  HeapFrame turned{{}, mainNormals(soup), true};
  for (const Eigen::Vector3d& p : soup.vertices) turned.places.push_back(turned.normals * p);
  const std::size_t across = joinCoordinates(turned.places);
  return double(across) < kFewer * double(along) ? turned : frame;
}

void moveToGrid(std::vector<Eigen::Vector3d>& places, double share) {
  if (share == 0) return;
  const double step = std::exp2(std::ceil(std::log2(largestOf(places)))) * share;
  for (Eigen::Vector3d& place : places) place = (place / step).array().round() * step;
}

std::vector<Eigen::Vector3d> placesBack(const HeapFrame& frame, const Soup& soup,
                                        std::vector<Eigen::Vector3d> places) {
  if (!frame.isTurned) return places;
  std::map<std::array<double, 3>, std::uint32_t> known;
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
    const Eigen::Vector3d& p = frame.places[v];
    known.try_emplace({p.x(), p.y(), p.z()}, v);
  }
  const Eigen::Matrix3d back = frame.normals.inverse();
  for (Eigen::Vector3d& p : places) {
    const auto at = known.find({p.x(), p.y(), p.z()});
    p = at == known.end() ? Eigen::Vector3d(back * p) : soup.vertices[at->second];
  }
  return places;
}

}  // namespace rubble::cooking
