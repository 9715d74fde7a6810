// Divergence of the face velocities [1/s], 0 in a solid: the right-hand side of the pressure.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_FACES) readonly buffer Faces { float bFaces[]; };
layout(std430, binding = DUST_BIND_RHS) writeonly buffer Divergence { float bDivergence[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sum += (bFaces[faceOf(axis, c + along(axis))] - bFaces[faceOf(axis, c)]) * params.inverse[axis];
  }
  bDivergence[index(c)] = bAir[index(c)] * sum;
}
