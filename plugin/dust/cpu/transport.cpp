#include "dust/cpu/transport.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/dust.h"

namespace rubble::dust {

namespace {

using PaddedRow = std::array<float, 256 + 8>;

// Courant number of the dust through a face. Between two cells of air that of the air; out of a solid at
// least the eviction; nothing into a solid nor inside one.
float courant(float value, float airLow, float airHigh) {
  const float outOfLow = std::max(value, shared::kDustEviction);
  const float outOfHigh = std::min(value, -shared::kDustEviction);
  const float oneSolid = airLow < airHigh ? outOfLow : outOfHigh;
  const float same = value * airLow;
  return airLow == airHigh ? same : oneSolid;
}

// Faces between the cells of rows `low` and `high`. Returns the largest |Courant number|.
float courantRow(int count, float scale, float settling, const float* airLow, const float* airHigh,
                 float* face) {
  float most = 0;
  for (int x = 0; x < count; ++x) {
    face[x] = courant((face[x] - settling) * scale, airLow[x], airHigh[x]);
    most = std::max(most, std::abs(face[x]));
  }
  return most;
}

float courantOfSlab(const Lattice& lattice, const Eigen::Vector3f& scale, float settling, int z,
                    Fields& fields) {
  const int n = lattice.n;
  float* faces = fields.faces.data();
  float most = 0;
  for (int y = 0; y < n; ++y) {
    const float* air = &fields.air[lattice.index(0, y, z)];
    float* fx = faces + lattice.face(0, 0, y, z);
    fx[0] *= scale.x() * air[0];
    fx[n] *= scale.x() * air[n - 1];
    most = std::max(
        {most, std::abs(fx[0]), std::abs(fx[n]), courantRow(n - 1, scale.x(), 0, air, air + 1, fx + 1)});
    const float* below = y > 0 ? air - n : air;
    most = std::max(most, courantRow(n, scale.y(), settling, below, air, faces + lattice.face(1, 0, y, z)));
    const float* front = z > 0 ? air - n * n : air;
    most = std::max(most, courantRow(n, scale.z(), 0, front, air, faces + lattice.face(2, 0, y, z)));
    if (y == n - 1) {
      most = std::max(most, courantRow(n, scale.y(), settling, air, air, faces + lattice.face(1, 0, n, z)));
    }
    if (z == n - 1) {
      most = std::max(most, courantRow(n, scale.z(), 0, air, air, faces + lattice.face(2, 0, y, n)));
    }
  }
  return most;
}

// Slope of the monotonised central limiter [vanLeer77], from the differences behind and ahead.
float limitedSlope(float behind, float ahead) {
  const float size =
      std::min(0.5f * std::abs(behind + ahead), 2 * std::min(std::abs(behind), std::abs(ahead)));
  return behind * ahead > 0 ? std::copysign(size, ahead) : 0;
}

// Density of the four cells around a face, and the Courant numbers of the face below, of itself and above.
struct Stencil {
  const float *lowest, *low, *high, *highest;
  const float *before, *face, *after;
};

// Flux through `count` faces [kg/m^3 of a cell]: the integral of the upwind cell's linear profile over the
// part that crosses. The profile is nowhere negative, and a cell that gives to both sides gives at most what
// it holds, so no density can fall below zero.
void fluxRow(int count, float share, const Stencil& s, float* flux) {
  for (int x = 0; x < count; ++x) {
    const float c = s.face[x] * share;
    const bool up = c > 0;
    const float gives = up ? c - std::min(s.before[x] * share, 0.0f) : std::max(s.after[x] * share, 0.0f) - c;
    const float cut = c / std::max(gives, 1.0f);
    const float own = up ? s.low[x] : s.high[x];
    const float ahead = up ? s.high[x] - s.low[x] : s.low[x] - s.high[x];
    const float behind = up ? s.low[x] - s.lowest[x] : s.high[x] - s.highest[x];
    flux[x] = cut * (own + 0.5f * (1 - std::abs(cut)) * limitedSlope(behind, ahead));
  }
}

// Nothing flows in from outside: there is no dust.
void clipToOutward(int k, int n, int count, float* flux) {
  for (int x = 0; k == 0 && x < count; ++x) flux[x] = std::min(flux[x], 0.0f);
  for (int x = 0; k == n && x < count; ++x) flux[x] = std::max(flux[x], 0.0f);
}

void applyFlux(int count, const float* in, const float* out, float* density) {
  for (int x = 0; x < count; ++x) density[x] = std::max(density[x] + (in[x] - out[x]), 0.0f);
}

double sumOf(int count, const float* values) {
  double sum = 0;
  for (int x = 0; x < count; ++x) sum += double{values[x]};
  return sum;
}

// One row along x. The density is copied with two ghosts on either side that repeat the last cell: no slope
// at a side.
double sweepRowX(int n, float share, const float* faces, float* density) {
  PaddedRow d, flux;
  std::copy_n(density, n, d.begin() + 2);
  d[0] = d[1] = density[0];
  d[n + 2] = d[n + 3] = density[n - 1];
  // The first and last faces have no face beyond; the flux there is cut to outward, where it is not read.
  PaddedRow c;
  std::copy_n(faces, n + 1, c.begin() + 1);
  c[0] = c[n + 2] = 0;
  const float* q = d.data();
  fluxRow(n + 1, share, {q, q + 1, q + 2, q + 3, c.data(), c.data() + 1, c.data() + 2}, flux.data());
  flux[0] = std::min(flux[0], 0.0f);
  flux[n] = std::max(flux[n], 0.0f);
  applyFlux(n, flux.data(), flux.data() + 1, density);
  return double{flux[n]} - double{flux[0]};
}

// Moves dust along y (axis 1) in slab z = `fixed`, or along z (axis 2) in slab y = `fixed`.
void sweepSlab(const Lattice& lattice, int axis, int fixed, float share, Fields& fields, Outflow& out) {
  const int n = lattice.n;
  const auto density = [&](int k) {
    k = std::clamp(k, 0, n - 1);
    return &fields.density[axis == 1 ? lattice.index(0, k, fixed) : lattice.index(0, fixed, k)];
  };
  const auto face = [&](int k) {
    k = std::clamp(k, 0, n);
    return &fields.faces[axis == 1 ? lattice.face(1, 0, k, fixed) : lattice.face(2, 0, fixed, k)];
  };
  // A row takes its flux when both its faces are done, and the next face still needs it and the row before as
  // they were: so rows are updated two faces late.
  PaddedRow flux[4];
  for (int k = 0; k <= n + 2; ++k) {
    if (k <= n) {
      float* f = flux[k % 4].data();
      fluxRow(n, share,
              {density(k - 2), density(k - 1), density(k), density(k + 1), face(k - 1), face(k), face(k + 1)},
              f);
      clipToOutward(k, n, n, f);
      if (k == 0) (axis == 1 ? out.settled : out.left) -= sumOf(n, f);
      if (k == n) out.left += sumOf(n, f);
    }
    if (k >= 3) applyFlux(n, flux[(k - 3) % 4].data(), flux[(k - 2) % 4].data(), density(k - 3));
  }
}

void sweep(const Lattice& lattice, int axis, float share, Fields& fields, std::vector<Outflow>& partial,
           base::ThreadPool& pool) {
  const int n = lattice.n;
  pool.run(n, n * n, [&](int begin, int end) {
    for (int slab = begin; slab < end; ++slab) {
      if (axis != 0) {
        sweepSlab(lattice, axis, slab, share, fields, partial[slab]);
        continue;
      }
      for (int y = 0; y < n; ++y) {
        const float* faces = &fields.faces[lattice.face(0, 0, y, slab)];
        partial[slab].left += sweepRowX(n, share, faces, &fields.density[lattice.index(0, y, slab)]);
      }
    }
  });
}

}  // namespace

int toCourantNumbers(const Lattice& lattice, float dt, float settling, Fields& fields,
                     base::ThreadPool& pool) {
  const int n = lattice.n;
  const Eigen::Vector3f scale = dt * lattice.cell.cwiseInverse();
  std::array<float, 256> most{};
  pool.run(n, 3 * n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) most[z] = courantOfSlab(lattice, scale, settling, z, fields);
  });
  const float largest = *std::max_element(most.begin(), most.begin() + n);
  return int(std::ceil(std::clamp(largest, 1.0f, float(shared::kDustMaxSubsteps))));
}

Outflow carryDust(const Lattice& lattice, int substeps, Fields& fields, std::vector<Outflow>& partial,
                  base::ThreadPool& pool) {
  std::fill(partial.begin(), partial.end(), Outflow{});
  const float share = 1 / float(substeps);
  for (int s = 0; s < substeps; ++s) {
    // Every other substep takes the axes in reverse, which cancels the bias of their order.
    for (int k = 0; k < 3; ++k) sweep(lattice, s % 2 == 0 ? k : 2 - k, share, fields, partial, pool);
  }
  Outflow total;
  for (const Outflow& p : partial) {
    total.settled += p.settled;
    total.left += p.left;
  }
  return total;
}

}  // namespace rubble::dust
