// What every solid hands to solid.frag; in the shadow pass only the place in the shadow map.
#ifdef RUBBLE_SHADOW_PASS
void emitSolid(vec3 position, vec3 normal, vec3 rest, float inner) {
  gl_Position = vec4((uFrame.worldToShadow * vec4(position, 1)).xyz * 2.0 - 1.0, 1);
}
#else
layout(location = 0) out vec3 vPosition;  // [m]
layout(location = 1) out vec3 vNormal;
layout(location = 2) out vec4 vRest;  // xyz place in the undeformed solid [m]; w 1 on fracture faces

void emitSolid(vec3 position, vec3 normal, vec3 rest, float inner) {
  vPosition = position;
  vNormal = normal;
  vRest = vec4(rest, inner);
  gl_Position = uFrame.viewProjection * vec4(position, 1);
}
#endif
