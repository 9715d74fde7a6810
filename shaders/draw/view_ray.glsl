// World position of a point of the picture; uv and depth in [0, 1].
vec3 worldAt(vec2 uv, float depth) {
  vec4 p = uFrame.inverseViewProjection * vec4(vec3(uv, depth) * 2.0 - 1.0, 1);
  return p.xyz / p.w;
}
