// Share of the sun that arrives at a point: x through the dust, y through dust and solids. A texel of the
// light volume holds the light at the end of its slice; before the first slice nothing is lost, behind the
// last the shadow goes on along the light.
layout(binding = RUBBLE_DUST_LIGHT_UNIT) uniform sampler3D uDustLight;

vec2 sunInDust(vec3 position) {
  float slices = float(textureSize(uDustLight, 0).z);
  vec3 q = (uFrame.worldToDustLight * vec4(position, 1)).xyz;
  vec2 light = textureLod(uDustLight, q - vec3(0, 0, 0.5 / slices), 0.0).rg;
  return mix(vec2(1), light, clamp(q.z * slices, 0.0, 1.0));
}
