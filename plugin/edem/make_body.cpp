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

// Returns the centre of mass, asset's frame [m].
template <class Real>
Eigen::Vector3d makeElements(BodyConstants<Real>& constants, const BodyDef& def) {
  const Asset& asset = *def.asset;
  const std::size_t n = asset.elementCount();
  constants.mass.resize(n);
  constants.inverseMass.resize(n);
  constants.inertia.resize(n);
  constants.inverseInertia.resize(n);
  constants.restCentred.resize(n);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    // Law 1: an object weighs what its solid weighs, and turns as its cells do.
    constants.mass[i] = def.material.density * asset.volumes[i];
    constants.inertia[i] =
        constants.mass[i] * std::max(asset.gyrations[i], 0.4 * asset.radius * asset.radius);
    constants.inverseMass[i] = Real(1 / constants.mass[i]);
    constants.inverseInertia[i] = Real(1 / constants.inertia[i]);
    centre += constants.mass[i] * asset.positions[i];
    total += constants.mass[i];
  }
  centre /= total;
  constants.lightest = *std::min_element(constants.mass.begin(), constants.mass.end());
  for (std::size_t i = 0; i < n; ++i) constants.restCentred[i] = asset.positions[i] - centre;
  constants.crushEnergy.assign(n, std::numeric_limits<Real>::infinity());
  for (std::size_t i = 0; i < def.crushEnergy.size(); ++i)
    constants.crushEnergy[i] = Real(def.crushEnergy[i]);
  return centre;
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
void makeSprings(BodyConstants<Real>& constants, BodyState<Real>& state, const BodyDef& def) {
  const Asset& asset = *def.asset;
  const std::size_t anchors = def.anchored ? asset.anchors.size() : 0;
  state.springs.reserve(asset.springs.size() + anchors);
  for (const AssetSpring& s : asset.springs) {
    const Eigen::Vector3d rest = asset.positions[s.second] - asset.positions[s.first];
    state.springs.push_back(
        makeSpring<Real>(s.first, s.second, s.area, rest.norm(), def.material, def.model));
    constants.springRest.push_back(rest);
    // DEVIATION (default): the paper's spring acts at the middle of d0, beside its face.
    constants.springOffset.push_back(def.model.rotationalStiffness
                                         ? centroidFromMiddle(asset, s)
                                         : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  }
  constants.anchorBegin = state.springs.size();
  for (std::size_t a = 0; a < anchors; ++a) {
    const AssetAnchor& anchor = asset.anchors[a];
    // The far end mirrors the element beyond the tied point, so the gap opens there; only the element's own
    // half is elastic, hence half the length.
    const Eigen::Vector3d rest = 2 * (anchor.point - asset.positions[anchor.element]);
    state.springs.push_back(makeSpring<Real>(anchor.element, anchor.element, anchor.area,
                                             anchorDepth(asset, anchor), def.material, def.model));
    constants.springRest.push_back(rest);
    constants.springOffset.push_back(Eigen::Vector3d::Zero());
  }
  state.anchorsIntact = std::uint32_t(anchors);
  state.intact.assign(state.springs.size(), 1);
}

// Dashpots c = beta k with beta = 2 xi / omega_max: the damping ratio is xi at the highest frequency, less
// below it.
template <class Real>
void makeDashpots(Body<Real>& body) {
  std::vector<ElementRates> rates(body.elementCount());
  springRates(body, std::span(rates));
  const double frequency2 = springBound(body, std::span<const ElementRates>(rates)).frequency2;
  if (frequency2 <= 0) return;
  const Real beta = Real(2 * body.constants->material.springDamping / std::sqrt(frequency2));
  for (Spring<Real>& s : body.state.springs) {
    s.damping = beta * s.stiffness;
    s.rotationalDamping = beta * s.rotational;
  }
}

template <class Real>
void indexSprings(BodyConstants<Real>& constants, const std::vector<Spring<Real>>& springs) {
  constants.springOffsets.assign(constants.mass.size() + 1, 0);
  const auto each = [&](auto&& f) {
    for (std::uint32_t s = 0; s < springs.size(); ++s) {
      f(springs[s].first, s);
      if (s < constants.anchorBegin) f(springs[s].second, s);
    }
  };
  each([&](std::uint32_t i, std::uint32_t) { ++constants.springOffsets[i + 1]; });
  std::partial_sum(constants.springOffsets.begin(), constants.springOffsets.end(),
                   constants.springOffsets.begin());
  constants.springsOf.resize(constants.springOffsets.back());
  std::vector<std::uint32_t> fill(constants.springOffsets.begin(), constants.springOffsets.end() - 1);
  each([&](std::uint32_t i, std::uint32_t s) { constants.springsOf[fill[i]++] = s; });
}

// Law 2: pairs joined by a spring, and pairs that overlap unjoined at rest, have a contact distance D
// of their own.
template <class Real>
void makePairs(BodyConstants<Real>& constants, BodyState<Real>& state) {
  const std::size_t n = constants.mass.size();
  struct Pair {
    std::uint32_t first, second;
    Real range;
  };
  std::vector<Pair> list;
  for (std::size_t s = 0; s < constants.anchorBegin; ++s)
    list.push_back({state.springs[s].first, state.springs[s].second, Real(2) * constants.radius});
  std::vector<std::vector<std::uint32_t>> joined(n);
  for (const Pair& p : list) joined[p.first].push_back(p.second);

  std::vector<Vec3<double>> points(constants.restCentred.begin(), constants.restCentred.end());
  const std::vector<std::uint8_t> all(n, 1);
  const double diameter = 2 * double(constants.radius);
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
  state.range.resize(list.size());
  for (std::uint32_t p = 0; p < list.size(); ++p) {
    state.range[p] = list[p].range;
    partners[list[p].first].push_back({list[p].second, p});
    partners[list[p].second].push_back({list[p].first, p});
  }
  constants.pairOffsets.assign(1, 0);
  for (auto& of : partners) {
    std::sort(of.begin(), of.end(),
              [](const PairIndex& a, const PairIndex& b) { return a.partner < b.partner; });
    constants.pairs.insert(constants.pairs.end(), of.begin(), of.end());
    constants.pairOffsets.push_back(std::uint32_t(constants.pairs.size()));
  }
}

template <class Real>
void makeContact(BodyConstants<Real>& constants) {
  const Material& m = constants.material;
  const double n = double(constants.mass.size());
  const double mass = std::accumulate(constants.mass.begin(), constants.mass.end(), 0.0) / n;
  const double inertia = std::accumulate(constants.inertia.begin(), constants.inertia.end(), 0.0) / n;
  const double radius = constants.asset->radius;
  constants.radius = Real(radius);
  ContactSide& contact = constants.contact;
  contact.stiffness = m.contactStiffness * m.youngsModulus * constants.asset->spacing();
  contact.mobility = 1 / mass;
  contact.turning = radius * radius / inertia;
  contact.radius = radius;
  contact.damping = m.contactDamping;
  contact.friction = constants.model.coulombFriction ? m.friction : -1;
  contact.rollingFriction = m.rollingFriction;
  contact.restitution = m.restitution;
  contact.memory = constants.model.contactMemory;
}

template <class Real>
void makeState(BodyState<Real>& state, const BodyConstants<Real>& constants, const Eigen::Vector3d& centre,
               const BodyDef& def) {
  const std::size_t n = constants.mass.size();
  state.turn = Eigen::Quaterniond(def.transform.linear()).normalized();
  state.origin = def.transform * centre;
  state.frames = {{state.origin, state.turn}};
  state.frameOf.assign(n, 0);
  for (auto* v : {&state.displacement, &state.velocityCarry}) v->assign(n, Vec3<Real>::Zero());
  state.rotation.assign(n, Quat<Real>::Identity());
  state.spin.assign(n, def.spin.cast<Real>());
  state.velocity.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    state.velocity[i] =
        (def.velocity + def.spin.cross(state.turn * constants.restCentred[i])).template cast<Real>();
  for (auto* v : {&state.sleeping, &state.slowTurned, &state.anchored}) v->assign(n, 0);
  for (auto* v : {&state.calmTime, &state.slowTime, &state.slowPeak}) v->assign(n, 0);
  state.alive.assign(n, 1);
  state.fragment.assign(n, 0);
  for (std::size_t a = constants.anchorBegin; a < state.springs.size(); ++a)
    state.anchored[state.springs[a].first] = 1;
}

template <class Real>
void makeWork(BodyWork<Real>& work, std::size_t n, std::size_t springs) {
  for (auto* v : {&work.force, &work.torque, &work.dampingForce, &work.dampingTorque})
    v->assign(n, Vec3<Real>::Zero());
  for (auto* v : {&work.rest, &work.position}) v->assign(n, Vec3<double>::Zero());
  work.load.assign(n, Real(0));
  work.touchesBegun.assign(n, 0);
  work.frozen.assign(n, 0);
  work.overloaded.reserve(springs);
  work.overloadMode.reserve(springs);
  work.crushing.reserve(n);
  work.leaving.assign(n, 0);
  work.springListed.assign(springs, 0);
}

}  // namespace

template <class Real>
Body<Real> makeBody(const BodyDef& def, std::uint32_t id) {
  check(def);
  const auto made = std::make_shared<BodyConstants<Real>>();
  BodyConstants<Real>& constants = *made;
  Body<Real> body;
  body.id = id;
  body.constants = made;
  constants.asset = def.asset;
  constants.material = def.material;
  constants.model = def.model;
  constants.massDamping = def.massDamping;
  const Eigen::Vector3d centre = makeElements(constants, def);
  makeSprings(constants, body.state, def);
  makeContact(constants);
  indexSprings(constants, body.state.springs);
  makePairs(constants, body.state);
  constants.criterion = makeCriterion<Real>(def.material, def.model);
  if (def.model.cellFaces) {
    constants.cells = std::make_shared<const CellFaces>(makeCellFaces(*def.asset));
    body.state.exposure = exposeOuter(*constants.cells);
  }
  makeState(body.state, constants, centre, def);
  makeWork(body.work, body.elementCount(), body.state.springs.size());
  turnRest(body, 0);
  makeDashpots(body);
  labelFragments(body);
  splitFrames(body);
  listAwake(body);
  return body;
}

template Body<float> makeBody(const BodyDef&, std::uint32_t);
template Body<double> makeBody(const BodyDef&, std::uint32_t);

}  // namespace rubble::edem
