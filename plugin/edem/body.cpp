#include "edem/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/number_text.h"
#include "edem/frames.h"
#include "edem/grid.h"
#include "edem/stable_step.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::edem {
namespace {

void requireWithin(const Eigen::Vector3d& v, const Limits& limits, const char* key, const char* unit,
                   const char* reason = "") {
  for (const double part : v)
    if (!limits.hold(part))
      throw Error(std::string("destructible body: ") + key + ": " + base::numberText(part) +
                  " is not allowed, each part must be " + limits.text() + unit + reason);
}

void check(const BodyDef& def) {
  if (!def.asset) throw Error("destructible body: asset: none given");
  if (def.asset->elementCount() == 0) throw Error("destructible body: asset: has no elements");
  def.asset->validate();
  rubble::check(def.material);
  if (!limits::kMassDamping.hold(def.massDamping))
    throw Error("destructible body: massDamping: " + base::numberText(def.massDamping) +
                " is not allowed, must be " + limits::kMassDamping.text() + " 1/s");
  if (!def.crushEnergy.empty() && def.crushEnergy.size() != def.asset->elementCount())
    throw Error("destructible body: crushEnergy: must have one value an element");
  requireWithin(def.transform.translation(), limits::kPosition, "transform: origin", " m",
                ": beyond, the floats of the world hold no centimetres");
  requireWithin(def.velocity, limits::kSpeed, "velocity", " m/s");
  requireWithin(def.spin, limits::kSpin, "spin", " rad/s");
  if (!def.transform.matrix().allFinite()) throw Error("destructible body: transform: must be finite");
  constexpr double kRounding = 1e-5;  // of a rotation that came through float
  const Eigen::Matrix3d turn = def.transform.linear();
  if (!(turn * turn.transpose()).isIdentity(kRounding) || turn.determinant() < 0)
    throw Error(
        "destructible body: transform: must be a rotation and a translation, without scale or mirror");
}

template <class Real>
void makeElements(Body<Real>& body, const BodyDef& def) {
  const Asset& asset = *def.asset;
  const std::size_t n = asset.elementCount();
  body.mass.resize(n);
  body.inverseMass.resize(n);
  body.inertia.resize(n);
  body.inverseInertia.resize(n);
  body.restCentred.resize(n);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    // Law 1: an object weighs what its solid weighs, and turns as its cells do.
    body.mass[i] = def.material.density * asset.volumes[i];
    body.inertia[i] = body.mass[i] * std::max(asset.gyrations[i], 0.4 * asset.radius * asset.radius);
    body.inverseMass[i] = Real(1 / body.mass[i]);
    body.inverseInertia[i] = Real(1 / body.inertia[i]);
    centre += body.mass[i] * asset.positions[i];
    total += body.mass[i];
  }
  centre /= total;
  for (std::size_t i = 0; i < n; ++i) body.restCentred[i] = asset.positions[i] - centre;
  body.turn = Eigen::Quaterniond(def.transform.linear()).normalized();
  body.origin = def.transform * centre;
}

// k = E A / |d0|, k_rot = E A^2 / (12 |d0|) (square face; bending and twist alike as the lattice has nu =
// 0).
template <class Real>
Spring<Real> makeSpring(std::uint32_t first, std::uint32_t second, double area, double length,
                        const Material& material, const Model& model) {
  Spring<Real> spring{};
  spring.first = first;
  spring.second = second;
  spring.area = Real(area);
  spring.stiffness = Real(material.youngsModulus * area / length);
  spring.rotational =
      model.rotationalStiffness ? Real(material.youngsModulus * area * area / (12 * length)) : Real(0);
  return spring;
}

// From the middle between the two elements to the centroid of the face that their cells share [m]. Elements
// stand beside where the cells were cut around them (cook/balance.h), so the face is not quite half-way.
Eigen::Vector3d centroidFromMiddle(const Asset& asset, const AssetSpring& spring) {
  const Eigen::Vector3d middle = 0.5 * (asset.positions[spring.first] + asset.positions[spring.second]);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double area = 0;
  for (const CellFace& face : asset.cellFaces(spring.first)) {
    if (face.neighbour != spring.second) continue;
    moment += double(face.area) * (face.centroid.cast<double>() - middle);
    area += double(face.area);
  }
  if (!(area > 0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d offset = moment / area;
  // Assets store centroids as floats: what may be their rounding is none, or a straight column would buckle.
  const double rounding = double(std::numeric_limits<float>::epsilon()) * middle.cwiseAbs().maxCoeff();
  return offset.norm() > rounding ? offset : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

// From an element square to the face that an anchor ties [m]: in an even strain the gap opens by that much of
// it, however far aside the face's centroid is.
double anchorDepth(const Asset& asset, const AssetAnchor& anchor) {
  constexpr double kLeast = 0.5;  // of the way to the centroid; less are cells that wrap around an edge
  const Eigen::Vector3d way = anchor.point - asset.positions[anchor.element];
  double depth = way.norm();
  double nearest = std::numeric_limits<double>::infinity();
  for (const CellFace& face : asset.cellFaces(anchor.element)) {
    if (face.neighbour != kNoElement) continue;
    const Eigen::Vector3d normal = face.normal.cast<double>();
    const double beside = std::abs(normal.dot(anchor.point - face.centroid.cast<double>()));
    if (beside >= nearest) continue;
    nearest = beside;
    depth = normal.dot(way);
  }
  return std::max(depth, kLeast * way.norm());
}

template <class Real>
void makeSprings(Body<Real>& body, const BodyDef& def) {
  const Asset& asset = *def.asset;
  const std::size_t anchors = def.anchored ? asset.anchors.size() : 0;
  body.springs.reserve(asset.springs.size() + anchors);
  for (const AssetSpring& s : asset.springs) {
    const Eigen::Vector3d rest = asset.positions[s.second] - asset.positions[s.first];
    body.springs.push_back(makeSpring<Real>(s.first, s.second, s.area, rest.norm(), def.material, def.model));
    body.springRest.push_back(rest);
    // DEVIATION (default): the paper's spring acts at the middle of d0, beside its face.
    body.springOffset.push_back(def.model.rotationalStiffness ? centroidFromMiddle(asset, s)
                                                              : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  }
  body.anchorBegin = body.springs.size();
  for (std::size_t a = 0; a < anchors; ++a) {
    const AssetAnchor& anchor = asset.anchors[a];
    // The far end mirrors the element beyond the tied point, so the gap opens there; only the element's own
    // half is elastic, hence half the length.
    const Eigen::Vector3d rest = 2 * (anchor.point - asset.positions[anchor.element]);
    body.springs.push_back(makeSpring<Real>(anchor.element, anchor.element, anchor.area,
                                            anchorDepth(asset, anchor), def.material, def.model));
    body.springRest.push_back(rest);
    body.springOffset.push_back(Eigen::Vector3d::Zero());
  }
  body.anchorsIntact = std::uint32_t(anchors);
  body.intact.assign(body.springs.size(), 1);
}

// Dashpots c = beta k with beta = 2 xi / omega_max: the damping ratio is xi at the highest frequency, less
// below it.
template <class Real>
void makeDashpots(Body<Real>& body) {
  std::vector<ElementRates> rates(body.elementCount());
  springRates(body, std::span(rates));
  const double frequency2 = springBound(body, std::span<const ElementRates>(rates)).frequency2;
  if (frequency2 <= 0) return;
  const Real beta = Real(2 * body.material.springDamping / std::sqrt(frequency2));
  for (Spring<Real>& s : body.springs) {
    s.damping = beta * s.stiffness;
    s.rotationalDamping = beta * s.rotational;
  }
}

template <class Real>
void indexSprings(Body<Real>& body) {
  body.springOffsets.assign(body.elementCount() + 1, 0);
  const auto each = [&](auto&& f) {
    for (std::uint32_t s = 0; s < body.springs.size(); ++s) {
      f(body.springs[s].first, s);
      if (!body.isAnchor(s)) f(body.springs[s].second, s);
    }
  };
  each([&](std::uint32_t i, std::uint32_t) { ++body.springOffsets[i + 1]; });
  std::partial_sum(body.springOffsets.begin(), body.springOffsets.end(), body.springOffsets.begin());
  body.springsOf.resize(body.springOffsets.back());
  std::vector<std::uint32_t> fill(body.springOffsets.begin(), body.springOffsets.end() - 1);
  each([&](std::uint32_t i, std::uint32_t s) { body.springsOf[fill[i]++] = s; });
}

// Law 2: pairs joined by a spring, and pairs that overlap unjoined at rest, have a contact distance D
// of their own.
template <class Real>
void makePairs(Body<Real>& body) {
  const std::size_t n = body.elementCount();
  struct Pair {
    std::uint32_t first, second;
    Real range;
  };
  std::vector<Pair> list;
  for (std::size_t s = 0; s < body.anchorBegin; ++s)
    list.push_back({body.springs[s].first, body.springs[s].second, Real(2) * body.radius});
  std::vector<std::vector<std::uint32_t>> joined(n);
  for (const Pair& p : list) joined[p.first].push_back(p.second);

  std::vector<Vec3<double>> points(body.restCentred.begin(), body.restCentred.end());
  const std::vector<std::uint8_t> all(n, 1);
  const double diameter = 2 * double(body.radius);
  Grid<double> grid;
  grid.build(points, all, diameter);
  const Vec3<double> reach = Vec3<double>::Constant(diameter);
  for (std::uint32_t i = 0; i < n; ++i) {
    grid.visitBox(points[i] - reach, points[i] + reach, [&](std::uint32_t j) {
      const double distance = (points[j] - points[i]).norm();
      if (j <= i || distance >= diameter) return;
      if (std::find(joined[i].begin(), joined[i].end(), j) == joined[i].end())
        list.push_back({i, j, Real(distance)});
    });
  }

  std::vector<std::vector<PairIndex>> partners(n);
  body.range.resize(list.size());
  for (std::uint32_t p = 0; p < list.size(); ++p) {
    body.range[p] = list[p].range;
    partners[list[p].first].push_back({list[p].second, p});
    partners[list[p].second].push_back({list[p].first, p});
  }
  body.pairOffsets.assign(1, 0);
  for (auto& of : partners) {
    std::sort(of.begin(), of.end(),
              [](const PairIndex& a, const PairIndex& b) { return a.partner < b.partner; });
    body.pairs.insert(body.pairs.end(), of.begin(), of.end());
    body.pairOffsets.push_back(std::uint32_t(body.pairs.size()));
  }
}

template <class Real>
void makeContact(Body<Real>& body) {
  const Material& m = body.material;
  const double n = double(body.elementCount());
  const double mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0) / n;
  const double inertia = std::accumulate(body.inertia.begin(), body.inertia.end(), 0.0) / n;
  const double radius = body.asset->radius;
  body.radius = Real(radius);
  ContactSide& contact = body.contact;
  contact.stiffness = m.contactStiffness * m.youngsModulus * body.asset->spacing();
  contact.mobility = 1 / mass;
  contact.turning = radius * radius / inertia;
  contact.radius = radius;
  contact.damping = m.contactDamping;
  contact.friction = body.model.coulombFriction ? m.friction : -1;
  contact.rollingFriction = m.rollingFriction;
  contact.restitution = m.restitution;
  contact.memory = body.model.contactMemory;
}

template <class Real>
void makeState(Body<Real>& body, const BodyDef& def) {
  const std::size_t n = body.elementCount();
  const Vec3<Real> zero = Vec3<Real>::Zero();
  for (auto* v : {&body.displacement, &body.velocityCarry, &body.force, &body.torque, &body.dampingForce,
                  &body.dampingTorque})
    v->assign(n, zero);
  for (auto* v : {&body.rest, &body.position}) v->assign(n, Vec3<double>::Zero());
  body.frames = {{body.origin, body.turn}};
  body.frameOf.assign(n, 0);
  body.rotation.assign(n, Quat<Real>::Identity());
  body.spin.assign(n, def.spin.cast<Real>());
  body.velocity.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    body.velocity[i] = (def.velocity + def.spin.cross(body.turn * body.restCentred[i])).template cast<Real>();
  body.alive.assign(n, 1);
  body.sleeping.assign(n, 0);
  body.calmTime.assign(n, 0);
  body.slowTime.assign(n, 0);
  body.slowPeak.assign(n, 0);
  body.slowTurned.assign(n, 0);
  body.load.assign(n, Real(0));
  body.touchesBegun.assign(n, 0);
  body.anchored.assign(n, 0);
  for (std::size_t a = body.anchorBegin; a < body.springs.size(); ++a)
    body.anchored[body.springs[a].first] = 1;
  body.overloaded.reserve(body.springs.size());
  body.overloadMode.reserve(body.springs.size());
  body.crushing.reserve(n);
  body.leaving.assign(n, 0);
  body.springListed.assign(body.springs.size(), 0);
  body.fragment.assign(n, 0);
  body.crushEnergy.assign(n, std::numeric_limits<Real>::infinity());
  for (std::size_t i = 0; i < def.crushEnergy.size(); ++i) body.crushEnergy[i] = Real(def.crushEnergy[i]);
}

}  // namespace

template <class Real>
Body<Real> makeBody(const BodyDef& def, std::uint32_t id) {
  check(def);
  Body<Real> body;
  body.id = id;
  body.asset = def.asset;
  body.material = def.material;
  body.model = def.model;
  body.massDamping = def.massDamping;
  makeElements(body, def);
  makeSprings(body, def);
  makeContact(body);
  makeState(body, def);
  turnRest(body, 0);
  makeDashpots(body);
  indexSprings(body);
  makePairs(body);
  if (def.model.cellFaces) {
    body.cells = std::make_shared<const CellFaces>(makeCellFaces(*def.asset));
    body.exposure = exposeOuter(*body.cells);
  }
  body.criterion = makeCriterion<Real>(def.material, def.model);
  labelFragments(body);
  splitFrames(body);
  listAwake(body);
  return body;
}

template <class Real>
void listAwake(Body<Real>& body) {
  body.awake.clear();
  for (std::uint32_t i = 0; i < body.elementCount(); ++i)
    if (body.alive[i] && !body.sleeping[i]) body.awake.push_back(i);
  body.awakeSprings.clear();
  for (std::uint32_t s = 0; s < body.springs.size(); ++s)
    if (body.intact[s] && !body.sleeping[body.springs[s].first]) body.awakeSprings.push_back(s);
}

template <class Real>
std::uint32_t labelFragments(Body<Real>& body) {
  std::vector<std::uint32_t>& root = body.fragment;
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t s = 0; s < body.anchorBegin; ++s) {
    if (!body.intact[s]) continue;
    const std::uint32_t a = find(body.springs[s].first), b = find(body.springs[s].second);
    if (a != b) root[std::max(a, b)] = std::min(a, b);
  }
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    root[i] = body.alive[i] ? find(i) : kNoElement;
    if (root[i] == i) ++count;
  }
  body.labelledBroken = body.brokenCount;
  return body.fragmentCount = count;
}

template struct Body<float>;
template struct Body<double>;
template Body<float> makeBody(const BodyDef&, std::uint32_t);
template Body<double> makeBody(const BodyDef&, std::uint32_t);
template void listAwake(Body<float>&);
template void listAwake(Body<double>&);
template std::uint32_t labelFragments(Body<float>&);
template std::uint32_t labelFragments(Body<double>&);

}  // namespace rubble::edem
