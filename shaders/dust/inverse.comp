// 1 / diagonal of the finest level, 0 in a solid.
#include "dust/grid.glsl"
#include "dust/finest.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_INVERSE) writeonly buffer Inverse { float bInverse[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  float diagonal = 0;
  for (int d = 0; d < 6; ++d) diagonal += finestWeight(c, d);
  bInverse[index(c)] = diagonal > 0 ? 1 / diagonal : 0;
}
