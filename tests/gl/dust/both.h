// A grid on either back end, side by side in one context.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "dust/cpu/cpu_dust.h"
#include "dust/gl/gl_dust.h"
#include "gl/context.h"
#include "support/folders.h"

namespace rubble::test {

inline constexpr float kStep = 1.0f / 60;  ///< [s]

class Both : public GlTest {
 protected:
  void make(const DustGridDef& def) {
    m_cpu = std::make_unique<dust::CpuDust>(def);
    m_gl = std::make_unique<dust::GlDust>(def, test::shaderFolder());
  }
  void TearDown() override { m_gl.reset(); }

  /// Cells of unequal sides, so that no axis can stand for another.
  static DustGridDef grid(int resolution = 32) {
    DustGridDef def;
    def.resolution = resolution;
    def.min = {-2, 0, -1.5f};
    def.max = {2, 3, 2.5f};
    def.grainRadius = 2e-5f;  // settles at about 0.12 m/s: seen within a few steps
    def.drag = 0.1f;
    return def;
  }

  void write(dust::Field field, const std::vector<float>& values) {
    m_cpu->write(field, values);
    m_gl->write(field, values);
  }
  std::vector<float> cpu(dust::Field field) const {
    std::vector<float> values;
    m_cpu->read(field, values);
    return values;
  }
  std::vector<float> gl(dust::Field field) const {
    std::vector<float> values;
    m_gl->read(field, values);
    return values;
  }

  struct Difference {
    double most = 0;  ///< largest |cpu - gl|
    double mean = 0;
    double scale = 0;  ///< largest |cpu|
  };
  Difference compare(dust::Field field) const {
    const std::vector<float> a = cpu(field), b = gl(field);
    Difference d;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double e = std::abs(double{a[i]} - double{b[i]});
      if (!(e <= d.most)) d.most = e;  // a NaN stays
      d.mean += e / double(a.size());
      d.scale = std::max(d.scale, std::abs(double{a[i]}));
    }
    return d;
  }
  /// Fails unless the fields differ by at most `tolerance` of the largest value, and there is one.
  void expectSame(dust::Field field, double tolerance) const {
    const Difference d = compare(field);
    EXPECT_GT(d.scale, 0);
    EXPECT_LE(d.most, tolerance * d.scale) << "field " << int(field) << ", largest " << d.scale;
  }

  std::unique_ptr<dust::CpuDust> m_cpu;
  std::unique_ptr<dust::GlDust> m_gl;
};

}  // namespace rubble::test
