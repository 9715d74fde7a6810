// Background in a direction: a gradient, and a glow around the sun.
vec3 skyColour(vec3 direction) {
  float height = sqrt(clamp(direction.y, 0.0, 1.0));
  float towardsSun = max(dot(direction, uFrame.sunDirection.xyz), 0.0);
  float wide = towardsSun * towardsSun;
  float glow = 0.09 * wide * wide * wide * wide * uFrame.tone.y;
  return mix(uFrame.skyHorizon.rgb, uFrame.skyZenith.rgb, height) + glow * uFrame.sunColour.rgb;
}
