// A compute shader, built from a file, and the sizes it is built for.
#pragma once

#include <string>
#include <utility>

#include "gl/name.h"

namespace rubble::dust {

class GlKernel {
 public:
  explicit GlKernel(gl::ProgramName program) : m_program(std::move(program)) {}

  void set(GLint location, int value) const { glProgramUniform1i(m_program.id(), location, value); }
  /// Runs so many work groups; later kernels see what it wrote.
  void run(int x, int y = 1, int z = 1) const;
  /// As many as the GPU has written at `offset` bytes of `arguments`.
  void runIndirect(GLuint arguments, std::size_t offset) const;

 private:
  gl::ProgramName m_program;
};

/// Builds kernels for a grid of n^3 cells.
class GlKernelSource {
 public:
  GlKernelSource(std::string shaderDirectory, int n);
  int n() const { return m_n; }
  int groupX() const { return m_groupX; }

  /// `file` in dust/ of the shader directory; `defines`: lines put before it. Throws rubble::Error with the
  /// file's name and the driver's log.
  GlKernel build(const std::string& file, const std::string& defines = "") const;
  /// One thread a cell of the grid.
  void runOnCells(const GlKernel& kernel) const;

 private:
  std::string m_directory;
  int m_n, m_groupX;
};

/// Edge of the work groups of the pressure kernels: as wide as the coarsest level.
constexpr int kLevelGroup = 4;
/// Work group of the kernels over a list.
constexpr int kListGroup = 64;

}  // namespace rubble::dust
