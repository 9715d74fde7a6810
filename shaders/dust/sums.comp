// Sums the density of chunks of cells, then what went through each of the six sides; the CPU adds up the few
// results. A sum is two floats, value and remainder, so no digit is lost before it reaches the CPU's doubles.
#include "dust/grid.glsl"
layout(local_size_x = DUST_SUM_GROUP) in;

layout(std430, binding = DUST_BIND_DENSITY) readonly buffer Density { float bDensity[]; };
layout(std430, binding = DUST_BIND_OUTFLOW) readonly buffer Outflow { vec2 bOutflow[]; };
layout(std430, binding = DUST_BIND_LIST) writeonly buffer Sums { vec2 bSums[]; };

shared vec2 sPartial[kDustSumThreads];

const int kChunks = (n * n * n + kDustSumChunk - 1) / kDustSumChunk;

// Knuth's sum without error of two floats, its remainder added to theirs.
vec2 add(vec2 a, vec2 b) {
  precise float s = a.x + b.x;
  precise float bb = s - a.x;
  precise float lost = (a.x - (s - bb)) + (b.x - bb);
  precise float low = lost + (a.y + b.y);
  return vec2(s, low);
}

vec2 sumOfCells(int chunk, int thread) {
  vec2 sum = vec2(0);
  int end = min((chunk + 1) * kDustSumChunk, n * n * n);
  for (int i = chunk * kDustSumChunk + thread; i < end; i += kDustSumThreads) {
    sum = add(sum, vec2(bDensity[i], 0));
  }
  return sum;
}

vec2 sumOfSide(int side, int thread) {
  vec2 sum = vec2(0);
  for (int i = thread; i < n * n; i += kDustSumThreads) {
    vec2 kahan = bOutflow[side * n * n + i];
    sum = add(sum, vec2(kahan.x, -kahan.y));
  }
  return sum;
}

void main() {
  int group = int(gl_WorkGroupID.x), thread = int(gl_LocalInvocationID.x);
  sPartial[thread] = group < kChunks ? sumOfCells(group, thread) : sumOfSide(group - kChunks, thread);
  for (int width = kDustSumThreads / 2; width > 0; width /= 2) {
    barrier();
    if (thread < width) sPartial[thread] = add(sPartial[thread], sPartial[thread + width]);
  }
  if (thread == 0) bSums[group] = sPartial[0];
}
