// One component of one cell: minus the mean gradient of its two faces; beside a wall the mean of its faces,
// so that the wall holds the air back.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_PRESSURE) readonly buffer Pressure { float bPressure[]; };
layout(std430, binding = DUST_BIND_VELOCITY_OUT) buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_FACES) readonly buffer Faces { float bFaces[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int i = index(c);
  if (bAir[i] == 0) return;
  float p = bPressure[i];
  vec4 u = bVelocity[i];
  for (int axis = 0; axis < 3; ++axis) {
    int low = index(max(c - along(axis), 0)), high = index(min(c + along(axis), n - 1));
    bool wall = bAir[low] == 0 || bAir[high] == 0 || (axis == 1 && c.y == 0);
    // Beyond an open side the ghost mirrors the cell with the other sign: the pressure is 0 on the side.
    float before = c[axis] > 0 ? bPressure[low] : -p;
    float after = c[axis] < n - 1 ? bPressure[high] : -p;
    float mean = 0.5 * (bFaces[faceOf(axis, c)] + bFaces[faceOf(axis, c + along(axis))]);
    u[axis] = wall ? mean : u[axis] - (after - before) * (0.5 * params.inverse[axis]);
  }
  bVelocity[i] = u;
}
