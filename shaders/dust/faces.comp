// Normal velocity of the faces: the mean of the two cells, or the solid's; the floor is closed; an open side
// lets the velocity of its cell through.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY) readonly buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_FACES) writeonly buffer Faces { float bFaces[]; };

float between(ivec3 low, ivec3 high, int axis) {
  int a = index(low), b = index(high);
  float u = bVelocity[a][axis], v = bVelocity[b][axis];
  if (bAir[a] == bAir[b]) return 0.5 * (u + v);
  return bAir[a] < bAir[b] ? u : v;
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  for (int axis = 0; axis < 3; ++axis) {
    bool floorFace = axis == 1 && c.y == 0;
    bFaces[faceOf(axis, c)] = floorFace ? 0 : between(max(c - along(axis), 0), c, axis);
    if (c[axis] == n - 1) bFaces[faceOf(axis, c + along(axis))] = bVelocity[index(c)][axis];
  }
}
