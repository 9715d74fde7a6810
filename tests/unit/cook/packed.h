// The elements as they are packed and cut, before all are stretched by what the solid's inertia wants.
#pragma once

#include "cook/elements.h"
#include "rubble/cook.h"

namespace rubble::test {

/// Starts at random, as every cook does first.
inline cooking::Elements pack(const SurfaceMesh& mesh, const CookOptions& options) {
  const cooking::CheckedMesh solid = cooking::checkMesh(mesh);
  return cooking::Packer(solid, options, [](double) {}).fill();
}

/// Starts evenly, as a cook does for solids with thin parts.
inline cooking::Elements packEvenly(const SurfaceMesh& mesh, const CookOptions& options) {
  const cooking::CheckedMesh solid = cooking::checkMesh(mesh);
  return cooking::Packer(solid, options, [](double) {}).fillEvenly();
}

}  // namespace rubble::test
