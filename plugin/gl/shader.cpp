#include "gl/shader.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "rubble/machine_error.h"

namespace rubble::gl {
namespace {

constexpr int kMaxIncludeDepth = 8;

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
    if (end == std::string::npos)
      throw MachineError("shader " + file + ": line " + std::to_string(number) + ": unclosed #include");
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

ShaderName compile(const std::string& directory, const Stage& stage) {
  const std::string text =
      "#version 430 core\n" + stage.defines + "#line 1\n" + readShader(directory, stage.file);
  ShaderName shader(glCreateShader(stage.type));
  if (shader.id() == 0)
    throw MachineError("shader " + stage.file + ": this context cannot make such a shader");
  const char* source = text.c_str();
  glShaderSource(shader.id(), 1, &source, nullptr);
  glCompileShader(shader.id());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (ok != GL_TRUE)
    throw MachineError("shader " + stage.file + ": " + logOf(shader.id(), glGetShaderiv, glGetShaderInfoLog));
  return shader;
}

}  // namespace

std::string readShader(const std::string& shaderDirectory, const std::string& file) {
  std::string text;
  splice(shaderDirectory, file, 0, text);
  return text;
}

ProgramName makeProgram(const std::string& shaderDirectory, std::initializer_list<Stage> stages) {
  ProgramName program(glCreateProgram());
  std::vector<ShaderName> shaders;
  std::string names;
  for (const Stage& stage : stages) {
    shaders.push_back(compile(shaderDirectory, stage));
    glAttachShader(program.id(), shaders.back().id());
    names += (names.empty() ? "" : ", ") + stage.file;
  }
  glLinkProgram(program.id());
  for (const ShaderName& shader : shaders) glDetachShader(program.id(), shader.id());
  GLint ok = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE)
    throw MachineError("shaders " + names + ": " + logOf(program.id(), glGetProgramiv, glGetProgramInfoLog));
  return program;
}

}  // namespace rubble::gl
