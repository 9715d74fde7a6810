// Adds the coarse correction: trilinear; mirrored with the other sign at an open side, with the same sign at
// the floor; solids are left out of the mean.
#define DUST_FINEST  // the coefficients are not needed
#include "dust/level.glsl"
layout(std430, binding = DUST_BIND_COARSE_PRESSURE) readonly buffer Coarse { float bCoarsePressure[]; };
layout(std430, binding = DUST_BIND_COARSE_INVERSE) readonly buffer CoarseInverse { float bCoarseInverse[]; };

const float kLeastShare = 1e-6;  // below the least weight of a corner, 1/64: only divides 0 by it

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int i = cellOf(c);
  if (bInverse[i] <= 0) return;
  int m = uSize / 2;
  ivec3 towards = 2 * (c & 1) - 1;
  float sum = 0, share = 0;
  for (int k = 0; k < 8; ++k) {
    ivec3 far = ivec3(k & 1, (k >> 1) & 1, k >> 2);
    ivec3 corner = c / 2 + far * towards;
    vec3 w = mix(vec3(0.75), vec3(0.25), equal(far, ivec3(1)));
    float weight = w.x * w.y * w.z, mirror = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner[axis] == m || (corner[axis] < 0 && axis != 1)) mirror = -mirror;
    }
    corner = clamp(corner, 0, m - 1);
    int j = (corner.z * m + corner.y) * m + corner.x;
    sum += mirror * weight * bCoarsePressure[j];
    share += bCoarseInverse[j] > 0 ? weight : 0;
  }
  bPressure[i] += sum / max(share, kLeastShare);
}
