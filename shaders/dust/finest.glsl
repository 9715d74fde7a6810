// The finest level's coefficient of a neighbour [1/m^2]; directions: low x, high x, low y, ...
layout(std430, binding = DUST_BIND_AIR) readonly buffer Air { float bAir[]; };

float finestWeight(ivec3 c, int direction) {
  int axis = direction / 2;
  float own = bAir[index(c)] * params.inverse[axis] * params.inverse[axis];
  ivec3 other = c + along(axis) * (2 * (direction & 1) - 1);
  if (other[axis] >= 0 && other[axis] < n) return own * bAir[index(other)];
  // Outside: the floor is closed; on an open side the pressure is 0 half a cell away.
  return direction == 2 ? 0 : 2 * own;
}
