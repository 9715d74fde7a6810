// Coefficients of a coarse level of uSize^3 cells: the mean of the four faces merged, and a quarter because
// cells are twice as large. The first coarse level (DUST_FINEST) reads the air itself.
#include "dust/grid.glsl"
#ifdef DUST_FINEST
#include "dust/finest.glsl"
#else
layout(std430, binding = DUST_BIND_WEIGHTS) readonly buffer Weights { float bWeights[]; };
#endif
layout(local_size_x = DUST_LEVEL_GROUP, local_size_y = DUST_LEVEL_GROUP, local_size_z = DUST_LEVEL_GROUP) in;

layout(std430, binding = DUST_BIND_COARSE_WEIGHTS) writeonly buffer CoarseWeights { float bCoarseWeights[]; };
layout(std430, binding = DUST_BIND_COARSE_INVERSE) writeonly buffer CoarseInverse { float bCoarseInverse[]; };
layout(location = DUST_UNIFORM_A) uniform int uSize;

float fineWeight(ivec3 c, int direction) {
#ifdef DUST_FINEST
  return finestWeight(c, direction);
#else
  int m = 2 * uSize;
  return bWeights[direction * m * m * m + (c.z * m + c.y) * m + c.x];
#endif
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int cells = uSize * uSize * uSize, i = (c.z * uSize + c.y) * uSize + c.x;
  float diagonal = 0;
  for (int d = 0; d < 6; ++d) {
    int axis = d / 2;
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
      ivec3 child = 2 * c + along(axis) * (d & 1);
      child += along((axis + 1) % 3) * (k & 1) + along((axis + 2) % 3) * (k / 2);
      sum += fineWeight(child, d);
    }
    bCoarseWeights[d * cells + i] = sum / 16;
    diagonal += sum / 16;
  }
  bCoarseInverse[i] = diagonal > 0 ? 1 / diagonal : 0;
}
