// Sunlight in the dust. The light volume is a box sheared along the sun's direction: its third axis follows
// the light, so a thread walks one column from the sunny side on and no slice waits for another.
#include "shared/draw.h"
layout(local_size_x = RUBBLE_LIGHT_GROUP, local_size_y = RUBBLE_LIGHT_GROUP) in;

layout(binding = RUBBLE_EXTINCTION_UNIT) uniform sampler3D uExtinction;
layout(binding = RUBBLE_SHADOW_UNIT) uniform sampler2DShadow uShadow;
// Light through the dust, and through dust and solids; at the end of each slice.
layout(binding = RUBBLE_DUST_LIGHT_IMAGE, rg16f) writeonly uniform image3D uLight;
layout(location = RUBBLE_GRID_UNIFORM) uniform ivec4 uGrid;

void main() {
  int n = uGrid.x;
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(column, ivec2(n)))) return;
  float depth = 0.0;  // optical
  for (int k = 0; k < n; ++k) {
    vec2 across = (vec2(column) + 0.5) / float(n);
    vec3 p = (uFrame.dustLightToWorld * vec4(across, (float(k) + 0.5) / float(n), 1)).xyz;
    vec3 g = (p - uFrame.dustMin.xyz) / (uFrame.dustMax.xyz - uFrame.dustMin.xyz);
    bool inside = all(greaterThanEqual(g, vec3(0))) && all(lessThanEqual(g, vec3(1)));
    float step = (inside ? textureLod(uExtinction, g, 0.0).r : 0.0) * uFrame.dustColour.w;
    depth += step;
    vec3 end = p - 0.5 * uFrame.dustColour.w * uFrame.sunDirection.xyz;
    vec3 s = (uFrame.worldToShadow * vec4(end, 1)).xyz;
    float solids = textureLod(uShadow, vec3(s.xy, clamp(s.z, 0.0, 1.0)), 0.0);
    float light = exp(-depth);
    imageStore(uLight, ivec3(column, k), vec4(light, light * solids, 0, 0));
  }
}
