// The mean residual of eight cells is the right-hand side of the coarse cell, which starts from zero
// pressure.
#include "dust/level.glsl"
layout(std430, binding = DUST_BIND_COARSE_PRESSURE) writeonly buffer Coarse { float bCoarsePressure[]; };
layout(std430, binding = DUST_BIND_COARSE_RHS) writeonly buffer CoarseRhs { float bCoarseRhs[]; };

float residual(ivec3 c) {
  int i = cellOf(c);
  return bInverse[i] > 0 ? bRhs[i] - neighbourSum(c) + bPressure[i] / bInverse[i] : 0;
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  float sum = 0;
  for (int k = 0; k < 8; ++k) sum += residual(2 * c + ivec3(k & 1, (k >> 1) & 1, k >> 2));
  int m = uSize / 2, i = (c.z * m + c.y) * m + c.x;
  bCoarseRhs[i] = sum / 8;
  bCoarsePressure[i] = 0;
}
