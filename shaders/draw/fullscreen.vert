// One triangle over the whole picture, at the far end of the depth range.
layout(location = 0) out vec2 vUv;

void main() {
  vUv = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
  gl_Position = vec4(vUv * 2.0 - 1.0, 1, 1);
}
