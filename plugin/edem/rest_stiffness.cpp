#include "edem/rest_stiffness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "rubble/asset.h"

namespace rubble::edem {
namespace {

Eigen::Matrix3d cross(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

// Rows: gap and relative rotation of a link; columns: motion of one of its elements. `side` is -1 for the
// first, 1 for the second. -(theta x h) = cross(h) theta.
Matrix6 strainOf(const RestLink& link, double side) {
  Matrix6 b = Matrix6::Zero();
  b.topLeftCorner<3, 3>().diagonal().setConstant(side);
  b.topRightCorner<3, 3>() = cross(side < 0 ? link.halfFirst : link.halfSecond);
  b.bottomRightCorner<3, 3>().diagonal().setConstant(side);
  return b;
}

// The same for the rigid motion of the element's group: u = U + Theta x arm.
Matrix6 strainOf(const RestLink& link, double side, const Eigen::Vector3d& arm) {
  Matrix6 b = strainOf(link, side);
  b.topRightCorner<3, 3>() -= side * cross(arm);
  return b;
}

Vector6 weights(const RestLink& link) {
  Vector6 k;
  k << Eigen::Vector3d::Constant(link.stiffness), Eigen::Vector3d::Constant(link.rotational);
  return k;
}

// Joins what links inside of one box connect: the lowest element of each part.
std::vector<std::uint32_t> partsOf(const RestStiffness& k, const std::vector<std::uint32_t>& box) {
  std::vector<std::uint32_t> root(k.elementCount(), 0u);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const RestLink& l : k.links) {
    if (l.second == kNoElement || box[l.first] != box[l.second]) continue;
    const std::uint32_t a = find(l.first), b = find(l.second);
    root[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

// The box of each element; kNoElement without a link.
std::vector<std::uint32_t> boxesOf(const RestStiffness& k, std::size_t wanted) {
  std::vector<std::uint32_t> box(k.elementCount(), kNoElement);
  for (const RestLink& l : k.links) {
    box[l.first] = 0;
    if (l.second != kNoElement) box[l.second] = 0;
  }
  Eigen::AlignedBox3d bounds;
  for (std::size_t i = 0; i < box.size(); ++i)
    if (box[i] == 0) bounds.extend(k.points[i]);
  if (bounds.isEmpty()) return box;
  // Flat and thin bodies are one box thick: no side counts less than the edge of a box, found by halving.
  const Eigen::Vector3d size = bounds.sizes();
  double low = 0, high = size.maxCoeff();
  const auto divisions = [&](double edge) -> Eigen::Array3d {
    return edge > 0 ? (size.array() / edge).round().max(1).eval() : Eigen::Array3d::Ones().eval();
  };
  for (int i = 0; i < 60 && high > 0; ++i) {
    const double edge = 0.5 * (low + high);
    (divisions(edge).prod() > double(wanted) ? low : high) = edge;
  }
  const Eigen::Array3d count = divisions(high);
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (box[i] == kNoElement) continue;
    const Eigen::Array3d share = (k.points[i] - bounds.min()).array() / size.array().max(1e-300);
    const Eigen::Array3d at = (share * count).floor().min(count - 1).max(0);
    box[i] = std::uint32_t(at.x() + count.x() * (at.y() + count.y() * at.z()));
  }
  return box;
}

// Strains of a link by the motions of the groups at its ends.
struct GroupStrains {
  const RestStiffness& k;
  const RigidGroups& groups;

  std::uint32_t groupOfFirst(const RestLink& l) const { return groups.of[l.first]; }
  std::uint32_t groupOfSecond(const RestLink& l) const {
    return l.second == kNoElement ? kNoElement : groups.of[l.second];
  }
  Matrix6 first(const RestLink& l) const { return of(l, l.first, -1); }
  Matrix6 second(const RestLink& l) const { return of(l, l.second, 1); }

 private:
  Matrix6 of(const RestLink& l, std::uint32_t i, double side) const {
    return strainOf(l, side, k.points[i] - groups.centre[groups.of[i]]);
  }
};

std::vector<Matrix6> groupDiagonals(const GroupStrains& strains) {
  const RestStiffness& k = strains.k;
  std::vector<Matrix6> diagonal(strains.groups.centre.size(), Matrix6::Zero());
  for (const std::uint32_t g : strains.groups.of)
    if (g != kNoElement) diagonal[g] += k.shift * Matrix6::Identity();
  for (const RestLink& l : k.links) {
    const std::uint32_t a = strains.groupOfFirst(l), b = strains.groupOfSecond(l);
    if (a == b) continue;
    const Matrix6 first = strains.first(l);
    diagonal[a] += first.transpose() * weights(l).asDiagonal() * first;
    if (b == kNoElement) continue;
    const Matrix6 second = strains.second(l);
    diagonal[b] += second.transpose() * weights(l).asDiagonal() * second;
  }
  return diagonal;
}

// A link between two groups, row > column.
struct Between {
  std::uint32_t row = 0, column = 0, link = 0;
};

// Those of one pair of groups stand side by side, in the order of the links.
std::vector<Between> linksBetween(const GroupStrains& strains) {
  std::vector<Between> between;
  for (std::uint32_t s = 0; s < strains.k.links.size(); ++s) {
    const RestLink& l = strains.k.links[s];
    const std::uint32_t a = strains.groupOfFirst(l), b = strains.groupOfSecond(l);
    if (b != kNoElement && a != b) between.push_back({std::max(a, b), std::min(a, b), s});
  }
  std::sort(between.begin(), between.end(), [](const Between& a, const Between& b) {
    return std::tie(a.row, a.column, a.link) < std::tie(b.row, b.column, b.link);
  });
  return between;
}

}  // namespace

void setShift(RestStiffness& k) {
  std::vector<Vector6> diagonal(k.elementCount(), Vector6::Zero());
  for (const RestLink& l : k.links) {
    diagonal[l.first] += (strainOf(l, -1).array().square().matrix().transpose() * weights(l));
    if (l.second != kNoElement)
      diagonal[l.second] += (strainOf(l, 1).array().square().matrix().transpose() * weights(l));
  }
  double largest = 0;
  for (const Vector6& d : diagonal) largest = std::max(largest, d.maxCoeff());
  k.shift = RestStiffness::kShift * largest;
}

void apply(const RestStiffness& k, const Eigen::VectorXd& x, Eigen::VectorXd& out) {
  out = k.shift * x;
  const double* const in = x.data();
  double* const sum = out.data();
  using In = Eigen::Map<const Eigen::Vector3d>;
  using Sum = Eigen::Map<Eigen::Vector3d>;
  for (const RestLink& l : k.links) {
    const double* const a = in + 6 * std::size_t(l.first);
    Eigen::Vector3d gap = l.halfFirst.cross(In(a + 3)) - In(a), twist = -In(a + 3);
    if (l.second != kNoElement) {
      const double* const b = in + 6 * std::size_t(l.second);
      gap += In(b) + l.halfSecond.cross(In(b + 3));
      twist += In(b + 3);
    }
    const Eigen::Vector3d force = l.stiffness * gap;
    const Eigen::Vector3d torque = l.rotational * twist;
    double* const first = sum + 6 * std::size_t(l.first);
    Sum(first) -= force;
    Sum(first + 3) -= l.halfFirst.cross(force) + torque;
    if (l.second == kNoElement) continue;
    double* const second = sum + 6 * std::size_t(l.second);
    Sum(second) += force;
    Sum(second + 3) += torque - l.halfSecond.cross(force);
  }
}

std::vector<Matrix6> diagonalBlocks(const RestStiffness& k) {
  std::vector<Matrix6> blocks(k.elementCount(), k.shift * Matrix6::Identity());
  const auto add = [&](const RestLink& l, std::uint32_t i, double side) {
    const Matrix6 b = strainOf(l, side);
    blocks[i] += b.transpose() * weights(l).asDiagonal() * b;
  };
  for (const RestLink& l : k.links) {
    add(l, l.first, -1);
    if (l.second != kNoElement) add(l, l.second, 1);
  }
  return blocks;
}

RigidGroups singleGroups(const RestStiffness& k) {
  RigidGroups groups;
  groups.of.assign(k.elementCount(), 0u);
  std::iota(groups.of.begin(), groups.of.end(), 0u);
  groups.centre = k.points;
  return groups;
}

RigidGroups boxGroups(const RestStiffness& k, std::size_t wanted) {
  RigidGroups groups;
  const std::vector<std::uint32_t> box = boxesOf(k, wanted);
  const std::vector<std::uint32_t> part = partsOf(k, box);
  groups.of.assign(k.elementCount(), kNoElement);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (box[i] == kNoElement) continue;
    if (part[i] == i) {
      groups.of[i] = count;
      ++count;
    }
    groups.of[i] = groups.of[part[i]];
  }
  groups.centre.assign(count, Eigen::Vector3d::Zero());
  std::vector<double> members(count, 0);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::uint32_t g = groups.of[i];
    if (g == kNoElement) continue;
    groups.centre[g] += k.points[i];
    ++members[g];
  }
  for (std::size_t g = 0; g < members.size(); ++g) groups.centre[g] /= members[g];
  return groups;
}

Eigen::SparseMatrix<double> groupedStiffness(const RestStiffness& k, const RigidGroups& groups) {
  const std::size_t count = groups.centre.size();
  const GroupStrains strains{k, groups};
  const std::vector<Matrix6> diagonal = groupDiagonals(strains);
  const std::vector<Between> between = linksBetween(strains);
  std::vector<Eigen::Triplet<double>> entries(21 * count);
  std::size_t filled = 0;
  for (std::size_t g = 0; g < count; ++g)
    for (int j = 0; j < 6; ++j)
      for (int i = j; i < 6; ++i)
        entries[filled++] = Eigen::Triplet<double>(6 * int(g) + i, 6 * int(g) + j, diagonal[g](i, j));
  for (std::size_t s = 0; s < between.size();) {
    const Between pair = between[s];
    Matrix6 block = Matrix6::Zero();
    for (; s < between.size() && between[s].row == pair.row && between[s].column == pair.column; ++s) {
      const RestLink& l = k.links[between[s].link];
      const bool firstIsRow = groups.of[l.first] == pair.row;
      const Matrix6 row = firstIsRow ? strains.first(l) : strains.second(l);
      const Matrix6 column = firstIsRow ? strains.second(l) : strains.first(l);
      block += row.transpose() * weights(l).asDiagonal() * column;
    }
    entries.resize(filled + 36);
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i)
        entries[filled++] =
            Eigen::Triplet<double>(6 * int(pair.row) + i, 6 * int(pair.column) + j, block(i, j));
  }
  Eigen::SparseMatrix<double> matrix(6 * Eigen::Index(count), 6 * Eigen::Index(count));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace rubble::edem
