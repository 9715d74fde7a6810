// Values of the velocity between the cells' centres, for both passes of MacCormack [Selle08]. A point outside
// takes the nearest point inside: the air beyond a side is like the air at it.
layout(std430, binding = DUST_BIND_VELOCITY) readonly buffer Velocity { vec4 bVelocity[]; };

struct Corner {
  int base;
  vec3 f;
};

// `point` in cells: a whole number is a cell's centre.
Corner locate(vec3 point) {
  vec3 p = bounded(vec4(point, 0), vec4(0), vec4(float(n - 1))).xyz;
  ivec3 c = min(ivec3(p), n - 2);
  return Corner(index(c), p - vec3(c));
}

vec4 blend(vec4 v[8], vec3 f) {
  vec4 low = mix(mix(v[0], v[1], f.x), mix(v[2], v[3], f.x), f.y);
  vec4 high = mix(mix(v[4], v[5], f.x), mix(v[6], v[7], f.x), f.y);
  return mix(low, high, f.z);
}

// Offset of corner k of eight.
int offsetOf(int k) { return (k & 1) + ((k >> 1) & 1) * n + (k >> 2) * n * n; }
