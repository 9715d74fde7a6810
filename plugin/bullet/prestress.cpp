#include "rubble/prestress.h"

#include <string>
#include <utility>

#include "base/number_text.h"
#include "bullet/body_def.h"
#include "edem/prestress.h"
#include "rubble/limits.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

void checkGravity(const Eigen::Vector3d& gravity) {
  for (const double part : gravity)
    if (!limits::kGravity.hold(part))
      throw Error("pre-stress: gravity: " + base::numberText(part) + " is not allowed, each part must be " +
                  limits::kGravity.text() + " m/s^2");
  if (gravity.isZero(0)) throw Error("pre-stress: gravity: must not be zero");
}

template <class Real>
AssetRest restOf(const edem::BodyDef& def, const Eigen::Vector3d& gravity) {
  AssetRest rest;
  const edem::PrestressResult result =
      edem::findRest(edem::makeBody<Real>(def, 0), gravity, edem::RestMethod::Chosen, rest);
  if (!result.applied()) throw Error("pre-stress: the body has no static state: " + result.reason);
  return rest;
}

}  // namespace

Asset prestress(const DestructibleBodyDef& def, const btVector3& gravity, Precision precision) {
  const edem::BodyDef elements = bullet::elementsOf(def);
  const Eigen::Vector3d g = bullet::toEigen(gravity);
  checkGravity(g);
  AssetRest rest = precision == Precision::Float ? restOf<float>(elements, g) : restOf<double>(elements, g);
  Asset asset = *def.asset;
  asset.rest = std::move(rest);
  return asset;
}

RUBBLE_ABI_END
}  // namespace rubble
