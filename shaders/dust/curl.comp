// Curl of the velocity [1/s], its length in the fourth component.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY) readonly buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_VELOCITY_2) writeonly buffer Curl { vec4 bCurl[]; };

// At a side the cell stands for its missing neighbour.
vec3 difference(ivec3 c, int axis) {
  vec3 low = bVelocity[index(max(c - along(axis), 0))].xyz;
  vec3 high = bVelocity[index(min(c + along(axis), n - 1))].xyz;
  return (high - low) * (0.5 * params.inverse[axis]);
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  vec3 dx = difference(c, 0), dy = difference(c, 1), dz = difference(c, 2);
  vec3 curl = vec3(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
  bCurl[index(c)] = vec4(curl, length(curl));
}
