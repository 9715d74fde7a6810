// The stable substep is f h sqrt(rho / E), h the elements' spacing. Cooked boxes (1 x 1 x 1, 1 x 1 x 0.08,
// 1 x 0.1 x 0.1, 10 x 1 x 0.2 m; 20 to 6000 elements; tied and free) had f from 0.25 to 0.41, 0.30 in the
// mean; in the paper's model 0.30.
#include "demo/substeps.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "demo/input_error.h"
#include "rubble/limits.h"

namespace rubble::demo {
namespace {

constexpr double kLongest = 0.45, kShortest = 0.24;
// In a run contacts shorten it, and a blow is resolved by steps of 0.35 of a contact's 1 / omega
// (plugin/edem/step_length.cpp): omega^2 is 4 k_c / m of two elements of half the mean mass.
constexpr double kContactsShorten = 1.5, kContactPhase = 0.35;
constexpr std::size_t kFewest = 20;  // with fewer f is another, and the cook takes no time

// A whole number of two digits and zeros.
std::string rounded(double value, double (*direction)(double)) {
  const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(value)) - 1));
  std::ostringstream text;
  text.precision(7);
  text << direction(value / unit) * unit;
  return text.str();
}

// Over that of springs without dashpots, from below: dashpots and stiff contacts shorten the substep.
double shortening(const Material& m) {
  const double springs = 4 / (kShortest * kShortest);  // omega^2 h^2 rho / E
  const double contacts = springs / 2 + 2 * m.contactStiffness;
  const double xi = contacts > springs ? std::max(m.springDamping, m.contactDamping) : m.springDamping;
  return std::sqrt(springs / std::max(springs, contacts)) * (std::sqrt(1 + xi * xi) - xi);
}

}  // namespace

std::vector<std::string> whatSubstepsDependOn() {
  return {"max_substeps_per_frame", "substep_safety"};
}

void requireSubsteps(const Scene& scene, std::size_t object, double volume, std::size_t elements) {
  if (elements < kFewest || !(volume > 0)) return;
  const SceneObject& o = scene.objects[object];
  const double crossing =
      std::cbrt(volume / double(elements)) * std::sqrt(o.material.density / o.material.youngsModulus);
  const double atLeast = 1.0 / 60 / (scene.substepSafety * kLongest * crossing);
  if (atLeast <= scene.maxSubstepsPerFrame) return;
  const double stable = scene.substepSafety * kShortest * shortening(o.material) / kContactsShorten,
               resolving = kContactPhase / std::sqrt(4 * o.material.contactStiffness);
  const double enough = 1.0 / 60 / (std::min(stable, resolving) * crossing);
  const double ratio = scene.maxSubstepsPerFrame / enough;
  std::string text = "needs more than " + rounded(atLeast, std::floor) +
                     " substeps in 1/60 s, max_substeps_per_frame is " +
                     std::to_string(scene.maxSubstepsPerFrame);
  const std::string name = "objects." + std::to_string(object);
  std::string would;
  const auto add = [&](const std::string& remedy) { would += (would.empty() ? ": " : " or ") + remedy; };
  if (limits::kMaxSubstepsPerFrame.hold(std::ceil(1.1 * enough))) add(rounded(enough, std::ceil));
  if (const double soft = o.material.youngsModulus * ratio * ratio; limits::kYoungsModulus.hold(soft))
    add("a youngs_modulus of " + rounded(soft, std::floor));
  if (const double fewer = std::floor(double(elements) * ratio * ratio * ratio); fewer >= kFewest)
    add(rounded(fewer, std::floor) + " elements");
  throw InputError(scene.blamed(name, whatSubstepsDependOn()), name,
                   text + (would.empty() ? ", must need less" : would + " would do"));
}

}  // namespace rubble::demo
