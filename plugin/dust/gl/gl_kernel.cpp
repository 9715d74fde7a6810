#include "dust/gl/gl_kernel.h"

#include <algorithm>
#include <utility>

#include "gl/shader.h"
#include "shared/dust.h"

namespace rubble::dust {

namespace {

// Work group of the kernels over cells: long along x, in which memory is laid out; 128 threads.
constexpr int kMostGroupX = 32;
constexpr int kGroupY = 4;

static_assert(kLevelGroup == shared::kDustCoarsest, "one group makes all sweeps of the coarsest level");

std::string define(const char* name, int value) {
  return std::string("#define ") + name + " " + std::to_string(value) + "\n";
}

}  // namespace

void GlKernel::run(int x, int y, int z) const {
  glUseProgram(m_program.id());
  glDispatchCompute(GLuint(x), GLuint(y), GLuint(z));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void GlKernel::runIndirect(GLuint arguments, std::size_t offset) const {
  glUseProgram(m_program.id());
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments);
  glDispatchComputeIndirect(GLintptr(offset));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

GlKernelSource::GlKernelSource(std::string shaderDirectory, int n)
    : m_directory(std::move(shaderDirectory)), m_n(n), m_groupX(std::min(n, kMostGroupX)) {}

GlKernel GlKernelSource::build(const std::string& file, const std::string& defines) const {
  const std::string sizes = define("DUST_N", m_n) + define("DUST_GROUP_X", m_groupX) +
                            define("DUST_GROUP_Y", kGroupY) + define("DUST_LEVEL_GROUP", kLevelGroup) +
                            define("DUST_LIST_GROUP", kListGroup) +
                            define("DUST_SUM_GROUP", shared::kDustSumThreads);
  return GlKernel(gl::makeProgram(m_directory, {{GL_COMPUTE_SHADER, "dust/" + file, sizes + defines}}));
}

void GlKernelSource::runOnCells(const GlKernel& kernel) const {
  kernel.run(m_n / m_groupX, m_n / kGroupY, m_n);
}

}  // namespace rubble::dust
