// All sweeps of the coarsest level in one work group, a thread a cell.
#include "dust/level.glsl"
shared float sPressure[kDustCoarsest * kDustCoarsest * kDustCoarsest];

float at(ivec3 c) {
  bool inside = all(greaterThanEqual(c, ivec3(0))) && all(lessThan(c, ivec3(kDustCoarsest)));
  return inside ? sPressure[cellOf(c)] : 0;
}

void main() {
  ivec3 c = ivec3(gl_LocalInvocationID);
  int i = cellOf(c);
  const int cells = kDustCoarsest * kDustCoarsest * kDustCoarsest;
  sPressure[i] = bPressure[i];
  for (int sweep = 0; sweep < 2 * kDustCoarsestSweeps; ++sweep) {
    barrier();
    if (((c.x + c.y + c.z + sweep) & 1) == 0) {
      float sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        sum += bWeights[2 * axis * cells + i] * at(c - along(axis));
        sum += bWeights[(2 * axis + 1) * cells + i] * at(c + along(axis));
      }
      sPressure[i] = (sum - bRhs[i]) * bInverse[i];
    }
  }
  bPressure[i] = sPressure[i];
}
