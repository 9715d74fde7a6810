// One level of the multigrid, of uSize^3 cells (laplace(p) = right-hand side). The finest level has constant
// coefficients and DUST_FINEST defined; cells of a solid and outside hold p = 0 and are left out of the
// diagonal.
#include "dust/grid.glsl"
layout(local_size_x = DUST_LEVEL_GROUP, local_size_y = DUST_LEVEL_GROUP, local_size_z = DUST_LEVEL_GROUP) in;

layout(std430, binding = DUST_BIND_PRESSURE) buffer Pressure { float bPressure[]; };
layout(std430, binding = DUST_BIND_RHS) readonly buffer Rhs { float bRhs[]; };
layout(std430, binding = DUST_BIND_INVERSE) readonly buffer Inverse { float bInverse[]; };
#ifndef DUST_FINEST
layout(std430, binding = DUST_BIND_WEIGHTS) readonly buffer Weights { float bWeights[]; };
#endif
layout(location = DUST_UNIFORM_A) uniform int uSize;

int cellOf(ivec3 c) { return (c.z * uSize + c.y) * uSize + c.x; }

float pressureAt(ivec3 c) {
  bool inside = all(greaterThanEqual(c, ivec3(0))) && all(lessThan(c, ivec3(uSize)));
  return inside ? bPressure[cellOf(c)] : 0;
}

// Sum of coefficient times pressure over the six neighbours.
float neighbourSum(ivec3 c) {
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    float low = pressureAt(c - along(axis)), high = pressureAt(c + along(axis));
#ifdef DUST_FINEST
    sum += params.inverse[axis] * params.inverse[axis] * (low + high);
#else
    int cells = uSize * uSize * uSize, i = cellOf(c);
    sum += bWeights[2 * axis * cells + i] * low + bWeights[(2 * axis + 1) * cells + i] * high;
#endif
  }
  return sum;
}
