// Definitions that are refused, and calls that may not harm.
#include <functional>
#include <limits>

#include "physics/bodies.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The message that adding the changed definition throws; empty if it is taken.
std::string refusal(const std::function<void(edem::BodyDef&)>& change) {
  edem::BodyDef def = block({2, 2, 2}, true);
  change(def);
  const auto solver = makeSolver<float>();
  try {
    solver->addBody(def, kGravity);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

TEST(HostileBody, TheUnchangedDefinitionIsTaken) {
  EXPECT_EQ(refusal([](edem::BodyDef&) {}), "");
}

TEST(HostileBody, BadMaterialIsRefusedByName) {
  const auto names = [](double Material::*field, double value) {
    return refusal([&](edem::BodyDef& d) { d.material.*field = value; });
  };
  for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
    EXPECT_NE(names(&Material::density, bad).find("density"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::youngsModulus, bad).find("youngsModulus"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::breakingAngle, bad).find("breakingAngle"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::contactStiffness, bad).find("contactStiffness"), std::string::npos) << bad;
  }
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    EXPECT_NE(names(&Material::tensileStrength, bad), "") << bad;
    EXPECT_NE(names(&Material::compressiveStrength, bad).find("compressiveStrength"), std::string::npos)
        << bad;
    EXPECT_NE(names(&Material::stretchThreshold, bad).find("stretchThreshold"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::springDamping, bad).find("springDamping"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::contactDamping, bad).find("contactDamping"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::friction, bad).find("friction"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::restitution, bad).find("restitution"), std::string::npos) << bad;
    EXPECT_NE(names(&Material::rollingFriction, bad).find("rollingFriction"), std::string::npos) << bad;
  }
}

TEST(HostileBody, BadPlaceOrMotionIsRefused) {
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.velocity.x() = kNaN; }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.spin.y() = kInfinity; }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.transform.translation().z() = kNaN; }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.massDamping = -1; }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.transform.linear().setZero(); }), "") << "not a rotation";
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.transform.linear() *= 2; }), "") << "scales";
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.transform.linear() *= -1; }), "") << "mirrors";
}

TEST(HostileBody, BadAssetIsRefused) {
  const auto changed = [](const std::function<void(Asset&)>& change) {
    return refusal([&](edem::BodyDef& d) {
      Asset asset = *d.asset;
      change(asset);
      d.asset = std::make_shared<const Asset>(asset);
    });
  };
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.asset.reset(); }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.asset = std::make_shared<const Asset>(); }), "");
  EXPECT_NE(changed([](Asset& a) { a.springs[0].second = 99; }), "");
  EXPECT_NE(changed([](Asset& a) { a.volumes[3] = kNaN; }), "");
  EXPECT_NE(changed([](Asset& a) { a.volumes.pop_back(); }), "");
  EXPECT_NE(changed([](Asset& a) { a.radius = 0; }), "");
  EXPECT_NE(refusal([](edem::BodyDef& d) { d.crushEnergy.assign(3, 1.0); }), "");
}

TEST(HostileBody, TooStiffForTheSubstepsIsRefusedWithTheStableStep) {
  const std::string text = refusal([](edem::BodyDef& d) {
    d.material.youngsModulus = limits::kYoungsModulus.high;
    d.material.density = limits::kDensity.low;
  });
  EXPECT_NE(text.find("stable substep"), std::string::npos);
  EXPECT_NE(text.find("maxSubstepsPerFrame"), std::string::npos);
}

TEST(HostileTick, NoTimeChangesNothing) {
  const auto solver = makeSolver<float>();
  edem::BodyDef def = block({2, 2, 2});
  def.spin = Eigen::Vector3d(0, 1, 0);
  solver->addBody(def, kNoGravity);
  const std::uint64_t before = solver->hash();
  for (const double dt : {0.0, -1.0, kNaN}) solver->tick(dt, kGravity, {});
  EXPECT_EQ(solver->hash(), before);
}

TEST(HostileTick, EmptySolverTicks) {
  const auto solver = makeSolver<float>();
  solver->tick(kFrame, kGravity, {});
  EXPECT_EQ(solver->failure(), "");
  EXPECT_FALSE(solver->anyAwake());
}

TEST(HostileTick, NotANumberStopsTheRunAndSaysWhere) {
  const auto solver = makeSolver<float>();
  const std::uint32_t id = solver->addBody(block({2, 2, 2}), kNoGravity);
  solver->tick(kFrame, Eigen::Vector3d(0, kNaN, 0), {});
  EXPECT_EQ(solver->failure().find("body " + std::to_string(id) + ": "), 0u);
  EXPECT_NE(solver->failure().find("first that of 0 in substep 0 of its tick"), std::string::npos)
      << solver->failure();
  solver->tick(kFrame, kGravity, {});
  EXPECT_EQ(solver->report().substeps, 0);
}

TEST(HostileTick, UnknownBodyIsRefused) {
  const auto solver = makeSolver<float>();
  EXPECT_THROW(solver->view(3), Error);
  EXPECT_THROW(solver->removeBody(0), Error);
}

}  // namespace
}  // namespace rubble::test
