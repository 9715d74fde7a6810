// Subtracts the gradient of the pressure from the faces that no solid closes. On an open side the pressure is
// 0 half a cell away.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_PRESSURE) readonly buffer Pressure { float bPressure[]; };
layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_FACES) buffer Faces { float bFaces[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  float p = bPressure[index(c)], air = bAir[index(c)];
  for (int axis = 0; axis < 3; ++axis) {
    float inverse = params.inverse[axis];
    if (c[axis] > 0) {
      int low = index(c - along(axis));
      bFaces[faceOf(axis, c)] -= (p - bPressure[low]) * inverse * (bAir[low] * air);
    } else if (axis != 1) {
      bFaces[faceOf(axis, c)] -= p * (2 * inverse) * air;
    }
    if (c[axis] == n - 1) bFaces[faceOf(axis, c + along(axis))] -= -p * (2 * inverse) * air;
  }
}
