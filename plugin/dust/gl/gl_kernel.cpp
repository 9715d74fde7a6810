#include "dust/gl/gl_kernel.h"

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

#include "rubble/machine_error.h"
#include "shared/dust.h"

namespace rubble::dust {

namespace {

constexpr int kMaxIncludeDepth = 8;
// Work group of the kernels over cells: long along x, in which memory is laid out; 128 threads.
constexpr int kMostGroupX = 32;
constexpr int kGroupY = 4;

static_assert(kLevelGroup == shared::kDustCoarsest, "one group makes all sweeps of the coarsest level");

std::string define(const char* name, int value) {
  return std::string("#define ") + name + " " + std::to_string(value) + "\n";
}

// The text of a file with `#include "..."` replaced, relative to the shader directory.
void splice(const std::string& directory, const std::string& file, int depth, std::string& out) {
  if (depth > kMaxIncludeDepth) throw MachineError("shader " + file + ": includes nested too deep");
  std::ifstream stream(directory + "/" + file);
  if (!stream) throw MachineError("shader " + file + ": cannot be read from " + directory);
  const std::string key = "#include \"";
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.rfind(key, 0) != 0) {
      out += line + "\n";
      continue;
    }
    const std::size_t end = line.find('"', key.size());
    if (end == std::string::npos) {
      throw MachineError("shader " + file + ": line " + std::to_string(number) + ": unclosed #include");
    }
    splice(directory, line.substr(key.size(), end - key.size()), depth + 1, out);
    out += "#line " + std::to_string(number + 1) + "\n";
  }
}

// Log of a shader or program, by its pair of functions.
template <class GetLength, class GetLog>
std::string logOf(GLuint id, GetLength getLength, GetLog getLog) {
  GLint length = 0;
  getLength(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(std::max(length, 0)), '\0');
  if (length > 0) getLog(id, length, nullptr, log.data());
  return log;
}

}  // namespace

GlKernel::~GlKernel() {
  if (m_program != 0) glDeleteProgram(m_program);
}

GlKernel::GlKernel(GlKernel&& other) noexcept : m_program(std::exchange(other.m_program, 0)) {}

void GlKernel::run(int x, int y, int z) const {
  glUseProgram(m_program);
  glDispatchCompute(GLuint(x), GLuint(y), GLuint(z));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void GlKernel::runIndirect(GLuint arguments, std::size_t offset) const {
  glUseProgram(m_program);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments);
  glDispatchComputeIndirect(GLintptr(offset));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

GlKernelSource::GlKernelSource(std::string shaderDirectory, int n)
    : m_directory(std::move(shaderDirectory)), m_n(n), m_groupX(std::min(n, kMostGroupX)) {}

GlKernel GlKernelSource::build(const std::string& file, const std::string& defines) const {
  std::string text = "#version 430 core\n" + define("DUST_N", m_n) + define("DUST_GROUP_X", m_groupX) +
                     define("DUST_GROUP_Y", kGroupY) + define("DUST_LEVEL_GROUP", kLevelGroup) +
                     define("DUST_LIST_GROUP", kListGroup) +
                     define("DUST_SUM_GROUP", shared::kDustSumThreads) + defines + "#line 1\n";
  splice(m_directory, "dust/" + file, 0, text);

  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  if (shader == 0) throw MachineError("shader dust/" + file + ": this context cannot make compute shaders");
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint ok = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok != GL_TRUE) {
    const std::string log = logOf(shader, glGetShaderiv, glGetShaderInfoLog);
    glDeleteShader(shader);
    throw MachineError("shader dust/" + file + ": " + log);
  }
  const GLuint program = glCreateProgram();
  GlKernel kernel(program);
  glAttachShader(program, shader);
  glLinkProgram(program);
  glDetachShader(program, shader);
  glDeleteShader(shader);
  ok = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE) {
    throw MachineError("shader dust/" + file + ": " + logOf(program, glGetProgramiv, glGetProgramInfoLog));
  }
  return kernel;
}

void GlKernelSource::runOnCells(const GlKernel& kernel) const {
  kernel.run(m_n / m_groupX, m_n / kGroupY, m_n);
}

}  // namespace rubble::dust
