// `rubble report CASE`: the closed forms, the list of cases, and the files. No time is asserted.
#include "demo/case_report.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "demo/cases/cases.h"
#include "demo/cases/lammps.h"
#include "demo/error_plot.h"
#include "demo/input_error.h"
#include "rubble/machine_error.h"
#include "scenes/parsed.h"
#include "scenes/xml.h"

namespace rubble::test {
namespace {

std::string refusalOf(std::vector<std::string> words) {
  words.insert(words.begin(), "report");
  try {
    parsed(words);
  } catch (const demo::InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(CaseReport, NamesAreCasesAndAScenesNameIsAScene) {
  EXPECT_EQ(parsed({"report", "cantilever"}).command, demo::CommandLine::Command::CaseReport);
  EXPECT_EQ(parsed({"report", "wall"}).command, demo::CommandLine::Command::Report);
  const demo::CommandLine line = parsed({"report", "--all", "--quick", "--out", "o", "--write", "w.md"});
  EXPECT_EQ(line.command, demo::CommandLine::Command::CaseReport);
  EXPECT_TRUE(line.caseReport.all);
  EXPECT_TRUE(line.caseReport.quick);
  EXPECT_EQ(line.caseReport.folder, "o");
  EXPECT_EQ(line.caseReport.write, "w.md");
}

TEST(CaseReport, ReferencesAreOfCasesThatHaveOneAndOfAllTheirSettings) {
  EXPECT_TRUE(parsed({"report", "wall_blow", "--reference"}).caseReport.reference);
  EXPECT_TRUE(parsed({"report", "--all", "--reference"}).caseReport.reference);
  EXPECT_NE(refusalOf({"wall_blow", "slide", "--reference"})
                .find("slide: has a closed form, must be one of: " + demo::referenceCaseNames()),
            std::string::npos);
  for (const char* other : {"wall", "materials"})
    EXPECT_NE(refusalOf({other, "--reference"}).find("must be left out"), std::string::npos) << other;
  EXPECT_NE(refusalOf({"wall_blow", "--reference", "--quick"}).find("--quick"), std::string::npos);
  for (const char* option : {"--out", "--write"})
    EXPECT_NE(refusalOf({"wall_blow", "--reference", option, "x"}).find(option), std::string::npos);
}

TEST(CaseReport, SettingsAreKeptOfCasesThatHaveAReferenceAndNothingElseIsRun) {
  EXPECT_TRUE(parsed({"report", "wall_blow", "--keep"}).caseReport.keep);
  EXPECT_NE(refusalOf({"wall_blow", "slide", "--keep"}).find("--keep: slide: has a closed form"),
            std::string::npos);
  EXPECT_NE(refusalOf({"wall_blow", "--keep", "--reference"}).find("must be left out"), std::string::npos);
  for (const char* other : {"wall", "materials", "stability"})
    EXPECT_NE(refusalOf({other, "--keep"}).find("must be left out"), std::string::npos) << other;
  for (const char* option : {"--out", "--write"})
    EXPECT_NE(refusalOf({"wall_blow", "--keep", option, "x"}).find("left out with --keep"),
              std::string::npos);
}

TEST(CaseReport, AnUnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_NE(refusalOf({"cantilevr"}).find("must be one of: " + demo::reportCaseNames() + ", column"),
            std::string::npos);
  EXPECT_NE(refusalOf({"cantilever", "wall"}).find("wall: is no case, must be one of: cantilever"),
            std::string::npos);
  EXPECT_NE(refusalOf({}).find("must have --all"), std::string::npos);
  for (const char* option : {"--set", "--sweep"})
    EXPECT_NE(refusalOf({"cantilever", option, "seed=1"}).find("is no scene"), std::string::npos);
  EXPECT_NE(refusalOf({"--all", "--seed", "2"}).find("is no scene"), std::string::npos);
  EXPECT_NE(refusalOf({"wall", "--quick"}).find("must be left out"), std::string::npos);
}

// Runs of a method stand together, or the plot would have two lines of one name; a quick report has some of
// each case; no run is there twice.
TEST(CaseReport, CasesAreWellFormed) {
  for (const demo::ReportCase& c : demo::reportCases()) {
    EXPECT_FALSE(c.what.empty() || c.closedForm.empty() || c.error.empty()) << c.name;
    std::set<std::string> methods, runs;
    std::string last;
    bool quick = false, standard = false;
    for (const demo::CaseRun& run : c.runs) {
      if (run.method != last) {
        EXPECT_TRUE(methods.insert(run.method).second) << c.name << ": " << run.method;
      }
      last = run.method;
      EXPECT_TRUE(runs.insert(run.method + run.setting).second) << c.name << ": " << run.setting;
      quick = quick || run.quick;
      standard = standard || run.standard;
    }
    EXPECT_TRUE(quick && standard) << c.name;
  }
}

TEST(CaseReport, TheHashKnowsTheCasesAndTheSolver) {
  demo::CaseReportOptions one;
  one.cases = {"cantilever"};
  const std::string first = demo::caseReportHash(one);
  EXPECT_EQ(first.size(), 16u);
  demo::CaseReportOptions quick = one;
  quick.quick = true;
  EXPECT_NE(demo::caseReportHash(quick), first);
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::caseReportHash(one, versions), first);
}

// Settings that are left out of --all are in the report that names all cases.
TEST(CaseReport, AllLeavesOutWhatIsOfNamedCasesOnly) {
  demo::CaseReportOptions all, named;
  all.all = true;
  for (const demo::ReportCase& c : demo::reportCases()) {
    named.cases.push_back(c.name);
    const auto isInAll = [](const demo::CaseRun& run) { return !run.namedOnly; };
    EXPECT_TRUE(std::ranges::any_of(c.runs, [&](const auto& run) { return run.standard && isInAll(run); }))
        << c.name;
  }
  EXPECT_NE(demo::caseReportHash(all), demo::caseReportHash(named));
  const demo::ReportCase* column = demo::findReportCase("column_blow");
  ASSERT_TRUE(column);
  EXPECT_EQ(std::ranges::count(column->runs, false, &demo::CaseRun::namedOnly), 2);  // it cannot be whole
  const demo::ReportCase* both = demo::findReportCase("two_fragile_blow");
  ASSERT_TRUE(both);
  EXPECT_EQ(std::ranges::count(both->runs, false, &demo::CaseRun::namedOnly), 3);
}

demo::ReportCase someCase() {
  const auto run = [](const char* method, const char* setting, bool standard) {
    return demo::CaseRun{method, setting, standard, false, {}};
  };
  return {.name = "a",
          .what = "b < c & \"d\"",
          .closedForm = "e",
          .error = "f, g",
          .runs = {run("one", "1, 2", true), run("one", "3", false), run("two", "4", false)}};
}

// 2 ms of a second in half a second are 4 ms a second.
TEST(CaseReport, TheCsvHasARowARun) {
  const demo::ReportCase c = someCase();
  const std::vector<demo::CaseRow> rows = {{&c.runs[0], {0.25, 0.002, 0.5}}, {&c.runs[2], {HUGE_VAL, 1, 1}}};
  const demo::TextRows table = demo::caseCsv(c, rows);
  ASSERT_EQ(table.size(), 3u);
  const std::vector<std::string> begin = {"case",    "method", "setting",
                                          "default", "error",  "ms_per_simulated_second"};
  EXPECT_TRUE(std::equal(begin.begin(), begin.end(), table[0].begin()));
  EXPECT_EQ(std::vector<std::string>(table[1].begin(), table[1].begin() + 6),
            (std::vector<std::string>{"a", "one", "1, 2", "1", "0.25", "4"}));
  EXPECT_EQ(table[2][4], "failed");
  for (const std::vector<std::string>& row : table) EXPECT_EQ(row.size(), table[0].size());
}

// What an error is made of stands behind; its reference and scatter are two rows more.
TEST(CaseReport, TheCsvHasTheQuantitiesBesideTheirReference) {
  const demo::ReportCase c = someCase();
  demo::CaseOutcome good{.error = 0.25, .simulatedSeconds = 1}, bad{.error = HUGE_VAL, .simulatedSeconds = 1};
  good.scatter = bad.scatter = 0.125;
  good.quantities = {{"h", 5, 4, 0.5}, {"i", 6, 8, 0.75}};
  bad.quantities = {{"h", NAN, 4, 0.5}, {"i", NAN, 8, 0.75}};
  const std::vector<demo::CaseRow> rows = {{&c.runs[0], good}, {&c.runs[2], bad}};
  const demo::TextRows table = demo::caseCsv(c, rows);
  ASSERT_EQ(table.size(), 5u);
  const std::vector<std::vector<std::string>> ends = {
      {"h", "i"}, {"5", "6"}, {"failed", "failed"}, {"4", "8"}, {"0.5", "0.75"}};
  for (std::size_t row = 0; row < table.size(); ++row) {
    EXPECT_EQ(table[row].size(), table[0].size());
    EXPECT_EQ(std::vector<std::string>(table[row].end() - 2, table[row].end()), ends[row]);
  }
  EXPECT_EQ(table[3][1], "reference");
  EXPECT_EQ(table[4][4], "0.125");
}

TEST(CaseReport, ThePictureIsXmlAndTellsWhatFailedAndWhatIsTooSmall) {
  demo::ReportCase c = someCase();
  c.note = "h is no i";
  const std::vector<demo::CaseRow> rows = {
      {&c.runs[0], {0, 0.002, 0.5}}, {&c.runs[1], {0.1, 1, 1}}, {&c.runs[2], {HUGE_VAL, 1, 1}}};
  const std::string svg = demo::caseSvg(c, rows);
  EXPECT_EQ(faultOfXml(svg), "");
  for (const char* words :
       {"Failed: two, 4.", "drawn at 1e-9", "Seed 1, commit ", "b &lt; c &amp; ", "h is no i."})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
}

// Equal ratios are equal lengths along both axes, a greater error stands higher, and one ring marks the
// default beside that of the legend.
TEST(ErrorPlot, IsLogarithmicBothWays) {
  const std::string svg =
      demo::svgOf(demo::ErrorPlot{.title = "t",
                                  .timeAxis = "x",
                                  .errorAxis = "y",
                                  .lines = {{"m", {{1, 0.1, true}, {10, 0.01}, {100, 0.001}}}},
                                  .notes = {}});
  EXPECT_EQ(faultOfXml(svg), "");
  std::vector<double> xs, ys;
  int rings = 0;
  for (auto at = svg.find("<circle"); at != svg.npos; at = svg.find("<circle", at + 1)) {
    const std::string circle = svg.substr(at, svg.find("/>", at) - at);
    if (circle.find("fill=\"none\"") != circle.npos) {
      ++rings;
      continue;
    }
    xs.push_back(std::stod(circle.substr(circle.find("cx=\"") + 4)));
    ys.push_back(std::stod(circle.substr(circle.find("cy=\"") + 4)));
  }
  EXPECT_EQ(rings, 2);
  ASSERT_EQ(xs.size(), 4u);  // three points and the legend
  EXPECT_GT(xs[1], xs[0]);
  EXPECT_GT(ys[1], ys[0]);
  EXPECT_NEAR(xs[2] - xs[1], xs[1] - xs[0], 0.01);  // printed to six digits
  EXPECT_NEAR(ys[2] - ys[1], ys[1] - ys[0], 0.01);
}

TEST(ErrorPlot, MarksALevel) {
  const std::string svg = demo::svgOf(demo::ErrorPlot{.title = "t",
                                                      .timeAxis = "x",
                                                      .errorAxis = "y",
                                                      .lines = {{"m", {{1, 0.1, true}, {10, 0.001}}}},
                                                      .level = 0.01,
                                                      .levelName = "scatter",
                                                      .notes = {}});
  EXPECT_EQ(faultOfXml(svg), "");
  EXPECT_NE(svg.find(">scatter</text>"), std::string::npos);
  // The plot reaches from y = 64 to 404; 0.01 is halfway between 0.1 and 0.001.
  EXPECT_NE(svg.find("y1=\"234\" x2=\"550\" y2=\"234\" stroke=\"#888888\""), std::string::npos);
}

// A slender beam sags by q L^4 / (8 E I) at its tip, and shear adds q L^2 / (2 kappa G A). Integrated anew:
// M(s) = q (L - s)^2 / 2 bends, and the tip's sag is the sum of M(s) (L - s) / (E I) by Mohr's theorem.
TEST(CantileverCase, TheSagIsThatOfMohrsIntegral) {
  const double length = 1.3, height = 0.2, density = 2000, modulus = 1e8, gravity = 9;
  const double q = density * gravity * height * height, bending = modulus * std::pow(height, 4) / 12;
  constexpr int kParts = 100000;
  double sag = 0;
  for (int i = 0; i < kParts; ++i) {
    const double arm = length * (i + 0.5) / kParts;  // L - s
    sag += q * arm * arm / 2 * arm / bending * length / kParts;
  }
  sag += q * length * length / 2 / (5.0 / 6 * modulus / 2 * height * height);
  EXPECT_NEAR(demo::timoshenkoSag(length, height, length, density, modulus, gravity), sag, 1e-8 * sag);
}

// Bullet's soft body has the sag at the tick and the iterations that kLST was fitted at, and at no other: a
// fiftieth of the mean sag, 1.1 % of the length, and more than it.
TEST(CantileverCase, TheFittedSoftBodySagsSoAtItsOwnTickAlone) {
  const demo::ReportCase c = demo::cantileverCase();
  int tried = 0;
  for (const demo::CaseRun& run : c.runs) {
    if (run.method != "Bullet's btSoftBody, kLST 0.38, 100 iterations") continue;
    const double error = run.run().error;
    if (run.setting == "1000 Hz") {
      EXPECT_LT(error, 0.011 / 50);
    } else {
      EXPECT_GT(error, 0.011) << run.setting;
    }
    ++tried;
  }
  EXPECT_EQ(tried, 2);
}

// A breaking impulse of F / 240 Hz is the force F r / 240 Hz at the rate r: parts at 1/4 of it at 60 Hz and
// at 25/6 at 1000 Hz. Of the elements 5 % is lost to the tick, a hundredth of the force at 60 Hz, and to the
// packing.
TEST(StrengthCase, ElementsKeepTheStrengthAtEveryRateAndABreakingImpulseDoesNot) {
  int elements = 0, bullet = 0;
  for (const demo::CaseRun& run : demo::strengthCase().runs) {
    if (run.standard) {
      EXPECT_LT(run.run().error, 0.05) << run.method;
      ++elements;
    }
    for (const auto& [rate, error] : {std::pair("60 Hz", 0.75), {"240 Hz", 0}, {"1000 Hz", 19.0 / 6}}) {
      if (run.method != std::string("Bullet's btFixedConstraint, ") + rate) continue;
      EXPECT_NEAR(run.run().error, error, 0.05) << run.method;
      ++bullet;
    }
  }
  EXPECT_EQ(elements, 3);
  EXPECT_EQ(bullet, 3);
}

// The same blow, step by step.
TEST(BounceCase, TheContactLastsAsLongAsAMassStaysOnASpring) {
  constexpr double kMass = 3, kStiffness = 700, kStep = 1e-6;
  double depth = 0, speed = 2, time = 0;
  do {
    speed -= kStep * kStiffness / kMass * depth;
    depth += kStep * speed;
    time += kStep;
  } while (depth > 0);
  EXPECT_NEAR(demo::springContactSeconds(kMass, kStiffness), time, 2 * kStep);
}

// A symmetric top turns about its momentum at L / I1 while it spins about its own axis at w3 (1 - I3 / I1)
// (Landau and Lifshitz, Mechanics, section 33).
TEST(FreeSpinCase, ASymmetricTopPrecessesRegularly) {
  const Eigen::Vector3d moments(0.4, 0.4, 0.7), spin(3, -2, 5);
  constexpr double kSeconds = 1.3;
  const Eigen::Vector3d momentum = moments.cwiseProduct(spin);
  const auto turned = [](const Eigen::Vector3d& by) {
    return Eigen::AngleAxisd(by.norm(), by.normalized()).toRotationMatrix();
  };
  const double own = spin.z() * (1 - moments.z() / moments.x());
  const Eigen::Matrix3d expected =
      turned(kSeconds / moments.x() * momentum) *
      Eigen::AngleAxisd(own * kSeconds, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d found = demo::tumbled(moments.asDiagonal(), spin, kSeconds);
  EXPECT_LT((found - expected).norm(), 1e-9);
}

TEST(SlideCase, TheWayIsThatOfASpeedThatFallsEvenly) {
  constexpr double kFriction = 0.4, kGravity = 9, kStep = 1e-6;
  double way = 0;
  for (double speed = 3; speed > 0; speed -= kStep * kFriction * kGravity) way += kStep * speed;
  EXPECT_NEAR(demo::stopDistance(3, kFriction, kGravity), way, 1e-5);
}

// Against Coulomb's law in small steps of time.
TEST(ReposeCase, WhatATiltingPlaneLetsGoHasSlidByTheAngle) {
  constexpr double kFriction = 0.4, kRate = 0.1, kGravity = 9.8, kStep = 1e-6;
  double angle = 0, speed = 0, way = 0;
  for (; way < 0.02; angle += kRate * kStep) {
    const double pull = kGravity * (std::sin(angle) - kFriction * std::cos(angle));
    speed = std::max(0.0, speed + kStep * pull);
    way += kStep * speed;
  }
  EXPECT_NEAR(demo::slidAngle(0.02, kFriction, kRate, kGravity), angle, 1e-5);
}

// Each slice carries what hangs below it: the strains of a million slices, summed.
TEST(HungCase, TheSinkIsTheSumOfTheStrains) {
  constexpr double kLength = 1.3, kDepth = 0.7, kDensity = 2000, kModulus = 1e7, kGravity = 9;
  constexpr int kSlices = 1'000'000;
  double sink = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double at = kDepth * (i + 0.5) / kSlices;
    sink += kDensity * kGravity * (kLength - at) / kModulus * kDepth / kSlices;
  }
  EXPECT_NEAR(demo::hungSink(kLength, kDepth, kDensity, kModulus, kGravity), sink, 1e-9 * sink);
}

// Of a row of masses m on springs k at distances a, the slowest of a tied and a free end has
// w = 2 sqrt(k / m) sin(pi / (2 (2 n + 1))), and a period is four ways of the wave.
TEST(WaveCase, FourWaysAreTheSlowestPeriodOfARowOfMasses) {
  constexpr double kLength = 1.3, kDensity = 2000, kModulus = 1e7, kArea = 0.01;
  constexpr int kMasses = 10000;
  const double a = kLength / kMasses, mass = kDensity * kArea * a, spring = kModulus * kArea / a;
  const double pi = std::numbers::pi;
  const double period = 2 * pi / (2 * std::sqrt(spring / mass) * std::sin(pi / (2 * (2 * kMasses + 1))));
  EXPECT_NEAR(4 * demo::waveSeconds(kLength, kDensity, kModulus), period, 1e-3 * period);
}

// The coarsest bar, two elements across: 2 % is what is promised of its stiffness, and half of that of the
// period, which goes by the root.
TEST(BarCases, TheElementsKeepTheClosedForms) {
  for (const auto& [c, tolerance] : {std::pair(demo::hungCase(), 0.02), std::pair(demo::waveCase(), 0.01)}) {
    int tried = 0;
    for (const demo::CaseRun& run : c.runs) {
      if (!run.standard) continue;
      EXPECT_LT(run.run().error, tolerance) << c.name << ", " << run.method;
      ++tried;
    }
    EXPECT_EQ(tried, 1) << c.name;
  }
}

// As LAMMPS of 29 Sep 2021 writes them, in parts.
TEST(Lammps, ItsLogIsRead) {
  const std::string log =
      "LAMMPS (29 Sep 2021 - Update 2)\nLoop time of 0.25 on 1 procs for 5000 steps with 1 atoms\n"
      "print \"answer $(v_v0:%.17g)\"\nanswer 0.5 -3e-2\nTotal wall time: 0:00:00\n";
  const demo::LammpsResult result = demo::readLammpsLog(log, 2);
  EXPECT_EQ(result.values, (std::vector<double>{0.5, -0.03}));
  EXPECT_EQ(result.processorSeconds, 0.25);
  EXPECT_THROW(demo::readLammpsLog(log, 3), MachineError);
  try {
    demo::readLammpsLog("ERROR: Unrecognized pair style 'gran/hooke' (src/force.cpp:257)\n", 1);
    ADD_FAILURE();
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(), "LAMMPS: ERROR: Unrecognized pair style 'gran/hooke' (src/force.cpp:257)");
  }
}

// It integrates the closed forms themselves: its errors are those of its timestep, 2500 of which a contact
// takes.
TEST(Lammps, ItsSphereKeepsTheClosedForms) {
  if (!demo::hasLammps()) GTEST_SKIP() << "LAMMPS is not installed";
  int tried = 0;
  for (const demo::ReportCase& c : {demo::bounceCase(), demo::rollCase()})
    for (const demo::CaseRun& run : c.runs) {
      if (!run.isForeign || run.setting != "timestep 1e-05 s") continue;
      EXPECT_LT(run.run().error, 1e-3) << c.name << ", " << run.method;
      ++tried;
    }
  EXPECT_EQ(tried, 3);
}

// Restitution as in tests/physics/restitution_test.cpp, e^2 to 0.01 + 0.02 e^2: at 0.5 to 0.015. Of the
// contact time one substep may be lost, 0.35 of the pi / omega (plugin/edem/step_length.cpp).
TEST(BounceCase, TheElementsKeepTheClosedForms) {
  int tried = 0;
  for (const demo::CaseRun& run : demo::bounceCase().runs) {
    if (!run.standard) continue;
    EXPECT_LT(run.run().error, run.method.starts_with("restitution") ? 0.015 : 0.35 / 3.14159) << run.method;
    ++tried;
  }
  EXPECT_EQ(tried, 4);  // block and sphere
}

}  // namespace
}  // namespace rubble::test
