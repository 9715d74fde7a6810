#include "gl/hostile.h"

#include <epoxy/gl.h>

#include <array>
#include <stdexcept>

namespace rubble::test {
namespace {

constexpr GLuint kUnits = 8, kBuffers = 8, kImages = 2;  // as many as any shader here uses

GLuint smallBuffer(GLenum target) {
  GLuint id = 0;
  glGenBuffers(1, &id);
  glBindBuffer(target, id);
  glBufferData(target, 256, nullptr, GL_STATIC_DRAW);
  return id;
}

GLuint smallTexture(GLenum target) {
  GLuint id = 0;
  glGenTextures(1, &id);
  glBindTexture(target, id);
  if (target == GL_TEXTURE_2D) glTexStorage2D(target, 1, GL_RGBA8, 4, 4);
  if (target == GL_TEXTURE_3D) glTexStorage3D(target, 1, GL_RGBA8, 4, 4, 4);
  if (target == GL_TEXTURE_2D_MULTISAMPLE) glTexStorage2DMultisample(target, 4, GL_RGBA8, 4, 4, GL_TRUE);
  return id;
}

GLuint smallFramebuffer() {
  const GLuint texture = smallTexture(GL_TEXTURE_2D);
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  return id;
}

// A program that puts every vertex at one point and names it for feedback.
GLuint pointProgram() {
  const char* text =
      "#version 430 core\nout vec4 vPlace;\nvoid main() { gl_Position = vPlace = vec4(0.5); }\n";
  const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  const char* varying = "vPlace";
  glTransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  return program;
}

void setPack() {
  for (const GLenum name : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST}) glPixelStorei(name, GL_TRUE);
  for (const GLenum name : {GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES})
    glPixelStorei(name, 3);
  glPixelStorei(GL_PACK_ROW_LENGTH, 640);
  glPixelStorei(GL_PACK_IMAGE_HEIGHT, 480);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
}
void setPackSkip() {
  glPixelStorei(GL_PACK_SKIP_PIXELS, 2);
}
void setPackInvert() {
  if (epoxy_has_gl_extension("GL_MESA_pack_invert")) glPixelStorei(GL_PACK_INVERT_MESA, GL_TRUE);
}
void setUnpack() {
  for (const GLenum name : {GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST}) glPixelStorei(name, GL_TRUE);
  for (const GLenum name : {GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS}) glPixelStorei(name, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 70);
  glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 70);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glPixelStorei(GL_UNPACK_SKIP_IMAGES, 1);
}
void setPixelBuffers() {
  smallBuffer(GL_PIXEL_PACK_BUFFER);
  smallBuffer(GL_PIXEL_UNPACK_BUFFER);
}
void setSamplers() {
  GLuint sampler = 0;
  glGenSamplers(1, &sampler);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glSamplerParameteri(sampler, wrap, GL_MIRRORED_REPEAT);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameterf(sampler, GL_TEXTURE_MIN_LOD, 4);
  for (GLuint unit = 0; unit < kUnits; ++unit) glBindSampler(unit, sampler);
}
void setTextures() {
  for (GLuint unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum target : {GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_2D_MULTISAMPLE})
      smallTexture(target);
  }
  for (GLuint i = 0; i < kImages; ++i)
    glBindImageTexture(i, smallTexture(GL_TEXTURE_2D), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
  glActiveTexture(GL_TEXTURE11);
}
void setBuffers() {
  for (GLuint i = 0; i < kBuffers; ++i)
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, smallBuffer(GL_SHADER_STORAGE_BUFFER), 0, 64);
  glBindBufferRange(GL_UNIFORM_BUFFER, 0, smallBuffer(GL_UNIFORM_BUFFER), 0, 64);
  for (const GLenum target : {GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_DRAW_INDIRECT_BUFFER,
                              GL_DISPATCH_INDIRECT_BUFFER, GL_ARRAY_BUFFER, GL_UNIFORM_BUFFER})
    smallBuffer(target);
}
void setProgram() {
  GLuint pipeline = 0;
  glGenProgramPipelines(1, &pipeline);
  glBindProgramPipeline(pipeline);
  glUseProgram(pointProgram());
}
void setVertexArray() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  glBindVertexArray(id);
  smallBuffer(GL_ELEMENT_ARRAY_BUFFER);
  for (GLuint i = 0; i < 6; ++i) glVertexAttrib4f(i, 7, -7, 7, -7);
}
void setFramebuffers() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, smallFramebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, smallFramebuffer());
  glReadBuffer(GL_NONE);
}
void setViewport() {
  for (GLuint i = 0; i < 4; ++i) glViewportIndexedf(i, 3.5f, 1.5f, 17, 11);
}
void setScissor() {
  glEnable(GL_SCISSOR_TEST);
  glScissor(2, 3, 5, 7);
}
void setClipControl() {
  if (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control"))
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
}
void setClipDistances() {
  for (GLenum i = 0; i < 8; ++i) glEnable(GL_CLIP_DISTANCE0 + i);
}
void setDepthRange() {
  glDepthRange(0.8, 0.3);
}
void setDepthTest() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_NEVER);
}
void setDepthMask() {
  glDepthMask(GL_FALSE);
}
void setDepthClamp() {
  glEnable(GL_DEPTH_CLAMP);
}
void setClearValues() {
  glClearDepth(0);
  glClearColor(1, 0, 1, 0);
  glClearStencil(3);
}
void setDiscard() {
  glEnable(GL_RASTERIZER_DISCARD);
}
void setSampleMask() {
  glEnable(GL_SAMPLE_MASK);
  glSampleMaski(0, 1);
}
void setAlphaToCoverage() {
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  glEnable(GL_SAMPLE_ALPHA_TO_ONE);
}
void setSampleCoverage() {
  glEnable(GL_SAMPLE_COVERAGE);
  glSampleCoverage(0.25f, GL_TRUE);
}
void setSampleShading() {
  glEnable(GL_SAMPLE_SHADING);
  glMinSampleShading(1);
}
void setNoMultisample() {
  glDisable(GL_MULTISAMPLE);
}
void setLogicOp() {
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_INVERT);
}
void setPrimitiveRestart() {
  glEnable(GL_PRIMITIVE_RESTART);
  glPrimitiveRestartIndex(2);
}
void setFixedRestart() {
  glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
}
void setBlend() {
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
  glBlendFunc(GL_CONSTANT_COLOR, GL_ONE);
  glBlendColor(0.3f, 0.6f, 0.9f, 0.1f);
}
void setBlendOfOne() {
  glEnablei(GL_BLEND, 0);
  glBlendFunci(0, GL_ZERO, GL_ONE);
}
void setPolygonMode() {
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_SMOOTH);
}
void setPolygonOffset() {
  for (const GLenum name : {GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT})
    glEnable(name);
  if (epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_polygon_offset_clamp")) {
    glPolygonOffsetClamp(-40, -4000, -0.5f);
  } else {
    glPolygonOffset(-40, -4000);
  }
}
void setColourMask() {
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
}
void setColourMaskOfOne() {
  glColorMaski(0, GL_FALSE, GL_FALSE, GL_TRUE, GL_FALSE);
}
void setStencil() {
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_NEVER, 1, 0xff);
}
void setCull() {
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT_AND_BACK);
  glFrontFace(GL_CW);
}
void setSrgb() {
  glEnable(GL_FRAMEBUFFER_SRGB);
}
void setDither() {
  glDisable(GL_DITHER);
}
void setProvokingVertex() {
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
}
void setHints() {
  glHint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_NICEST);
  glHint(GL_POLYGON_SMOOTH_HINT, GL_NICEST);
}
void setErrors() {
  glEnable(GL_TEXTURE_2D_MULTISAMPLE);  // not a switch
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1u << 30, 0);
}
// Of a query that no sample has passed.
void setConditionalRender() {
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  glBeginConditionalRender(query, GL_QUERY_WAIT);
}
void setFeedback() {
  GLboolean active = GL_FALSE;
  glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
  if (active == GL_TRUE) return;
  glUseProgram(pointProgram());
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, smallBuffer(GL_TRANSFORM_FEEDBACK_BUFFER));
  glBeginTransformFeedback(GL_POINTS);
}

void setAll();

constexpr std::array kKinds{
    Hostility{"Pack", setPack},
    Hostility{"PackSkip", setPackSkip},
    Hostility{"PackInvert", setPackInvert},
    Hostility{"Unpack", setUnpack},
    Hostility{"PixelBuffers", setPixelBuffers},
    Hostility{"Samplers", setSamplers},
    Hostility{"Textures", setTextures},
    Hostility{"Buffers", setBuffers},
    Hostility{"Program", setProgram},
    Hostility{"VertexArray", setVertexArray},
    Hostility{"Framebuffers", setFramebuffers},
    Hostility{"Viewport", setViewport},
    Hostility{"Scissor", setScissor},
    Hostility{"ClipControl", setClipControl},
    Hostility{"ClipDistances", setClipDistances},
    Hostility{"DepthRange", setDepthRange},
    Hostility{"DepthTest", setDepthTest},
    Hostility{"DepthMask", setDepthMask},
    Hostility{"DepthClamp", setDepthClamp},
    Hostility{"ClearValues", setClearValues},
    Hostility{"Discard", setDiscard},
    Hostility{"SampleMask", setSampleMask},
    Hostility{"AlphaToCoverage", setAlphaToCoverage},
    Hostility{"SampleCoverage", setSampleCoverage},
    Hostility{"SampleShading", setSampleShading},
    Hostility{"NoMultisample", setNoMultisample},
    Hostility{"LogicOp", setLogicOp},
    Hostility{"PrimitiveRestart", setPrimitiveRestart},
    Hostility{"FixedRestart", setFixedRestart},
    Hostility{"Blend", setBlend},
    Hostility{"BlendOfOne", setBlendOfOne},
    Hostility{"PolygonMode", setPolygonMode},
    Hostility{"PolygonOffset", setPolygonOffset},
    Hostility{"ColourMask", setColourMask},
    Hostility{"ColourMaskOfOne", setColourMaskOfOne},
    Hostility{"Stencil", setStencil},
    Hostility{"Cull", setCull},
    Hostility{"Srgb", setSrgb},
    Hostility{"Dither", setDither},
    Hostility{"ProvokingVertex", setProvokingVertex},
    Hostility{"Hints", setHints},
    Hostility{"Errors", setErrors},
    Hostility{"ConditionalRender", setConditionalRender},
    Hostility{"Feedback", setFeedback},
    Hostility{"All", setAll},
};

// Feedback last: once it is in progress no other program can be put to use.
void setAll() {
  for (const Hostility& kind : kKinds)
    if (kind.set != setAll) kind.set();
}

constexpr GLenum kSwitches[] = {
    GL_BLEND,
    GL_COLOR_LOGIC_OP,
    GL_CULL_FACE,
    GL_DEPTH_CLAMP,
    GL_DEPTH_TEST,
    GL_DITHER,
    GL_FRAMEBUFFER_SRGB,
    GL_MULTISAMPLE,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE,
    GL_POLYGON_OFFSET_POINT,
    GL_POLYGON_SMOOTH,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_RASTERIZER_DISCARD,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_MASK,
    GL_SAMPLE_SHADING,
    GL_SCISSOR_TEST,
    GL_STENCIL_TEST,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE7,
    GL_DEBUG_OUTPUT,
};
constexpr GLenum kValues[] = {
    GL_PACK_SWAP_BYTES,
    GL_PACK_LSB_FIRST,
    GL_PACK_ROW_LENGTH,
    GL_PACK_IMAGE_HEIGHT,
    GL_PACK_SKIP_ROWS,
    GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_IMAGES,
    GL_PACK_ALIGNMENT,
    GL_UNPACK_SWAP_BYTES,
    GL_UNPACK_LSB_FIRST,
    GL_UNPACK_ROW_LENGTH,
    GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_SKIP_ROWS,
    GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_SKIP_IMAGES,
    GL_UNPACK_ALIGNMENT,
    GL_PIXEL_PACK_BUFFER_BINDING,
    GL_PIXEL_UNPACK_BUFFER_BINDING,
    GL_COPY_READ_BUFFER_BINDING,
    GL_COPY_WRITE_BUFFER_BINDING,
    GL_DRAW_INDIRECT_BUFFER_BINDING,
    GL_DISPATCH_INDIRECT_BUFFER_BINDING,
    GL_ARRAY_BUFFER_BINDING,
    GL_ELEMENT_ARRAY_BUFFER_BINDING,
    GL_SHADER_STORAGE_BUFFER_BINDING,
    GL_UNIFORM_BUFFER_BINDING,
    GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
    GL_VERTEX_ARRAY_BINDING,
    GL_CURRENT_PROGRAM,
    GL_PROGRAM_PIPELINE_BINDING,
    GL_ACTIVE_TEXTURE,
    GL_DRAW_FRAMEBUFFER_BINDING,
    GL_READ_FRAMEBUFFER_BINDING,
    GL_DEPTH_FUNC,
    GL_DEPTH_WRITEMASK,
    GL_DEPTH_CLEAR_VALUE,
    GL_STENCIL_CLEAR_VALUE,
    GL_CULL_FACE_MODE,
    GL_FRONT_FACE,
    GL_PROVOKING_VERTEX,
    GL_LOGIC_OP_MODE,
    GL_PRIMITIVE_RESTART_INDEX,
    GL_POLYGON_OFFSET_FACTOR,
    GL_POLYGON_OFFSET_UNITS,
    GL_SAMPLE_COVERAGE_VALUE,
    GL_SAMPLE_COVERAGE_INVERT,
    GL_MIN_SAMPLE_SHADING_VALUE,
    GL_FRAGMENT_SHADER_DERIVATIVE_HINT,
    GL_STENCIL_FUNC,
    GL_BLEND_EQUATION_RGB,
    GL_BLEND_SRC_RGB,
    GL_BLEND_DST_RGB,
    GL_TRANSFORM_FEEDBACK_ACTIVE,
    GL_TRANSFORM_FEEDBACK_PAUSED,
    GL_READ_BUFFER,
};
constexpr GLenum kValuesByIndex[] = {GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                     GL_SHADER_STORAGE_BUFFER_SIZE};
constexpr GLenum kValuesOfUnit[] = {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D,
                                    GL_TEXTURE_BINDING_2D_MULTISAMPLE, GL_SAMPLER_BINDING};
constexpr GLenum kValuesOfImage[] = {GL_IMAGE_BINDING_NAME,    GL_IMAGE_BINDING_LEVEL,
                                     GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                     GL_IMAGE_BINDING_ACCESS,  GL_IMAGE_BINDING_FORMAT};

double valueOf(GLenum name) {
  std::array<GLdouble, 16> values{};
  glGetDoublev(name, values.data());
  return values[0];
}

double valueOf(GLenum name, GLuint index) {
  GLint64 value = 0;
  glGetInteger64i_v(name, index, &value);
  return double(value);
}

std::vector<double> valuesOf(GLenum name, std::size_t count) {
  std::vector<double> values(16);
  glGetDoublev(name, values.data());
  values.resize(count);
  return values;
}

}  // namespace

std::span<const Hostility> hostilities() {
  return kKinds;
}

const Hostility& hostility(const std::string& name) {
  for (const Hostility& kind : kKinds)
    if (kind.name == name) return kind;
  throw std::invalid_argument(name);
}

std::map<std::string, std::vector<double>> stateOfContext() {
  std::map<std::string, std::vector<double>> state;
  std::vector<double>&switches = state["switches"], &values = state["values"], &buffers = state["buffers"];
  for (const GLenum name : kSwitches) switches.push_back(glIsEnabled(name));
  for (const GLenum name : kValues) values.push_back(valueOf(name));
  for (GLuint i = 0; i < kBuffers; ++i)
    for (const GLenum name : kValuesByIndex) buffers.push_back(valueOf(name, i));
  for (const GLenum name : {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE})
    buffers.push_back(valueOf(name, 0));
  const auto active = GLenum(valueOf(GL_ACTIVE_TEXTURE));
  for (GLuint unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum name : kValuesOfUnit) state["units"].push_back(valueOf(name));
  }
  glActiveTexture(active);
  for (GLuint i = 0; i < kImages; ++i)
    for (const GLenum name : kValuesOfImage) state["images"].push_back(valueOf(name, i));
  for (GLuint i = 0; i < 8; ++i) {
    std::array<GLboolean, 4> mask{};
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
    state["masks"].insert(state["masks"].end(), mask.begin(), mask.end());
    state["blends"].push_back(glIsEnabledi(GL_BLEND, i));
  }
  for (GLuint i = 0; i < 4; ++i) {
    std::array<GLdouble, 4> box{}, range{};
    glGetDoublei_v(GL_VIEWPORT, i, box.data());
    glGetDoublei_v(GL_DEPTH_RANGE, i, range.data());
    state["viewports"].insert(state["viewports"].end(), box.begin(), box.end());
    state["ranges"].insert(state["ranges"].end(), range.begin(), range.begin() + 2);
    state["scissors"].push_back(glIsEnabledi(GL_SCISSOR_TEST, i));
  }
  state["scissor"] = valuesOf(GL_SCISSOR_BOX, 4);
  state["polygons"] = valuesOf(GL_POLYGON_MODE, 1);
  state["clear"] = valuesOf(GL_COLOR_CLEAR_VALUE, 4);
  if (epoxy_gl_version() >= 45) state["clip"] = {valueOf(GL_CLIP_ORIGIN), valueOf(GL_CLIP_DEPTH_MODE)};
  if (epoxy_has_gl_extension("GL_ARB_polygon_offset_clamp"))
    state["clamp"] = {valueOf(GL_POLYGON_OFFSET_CLAMP)};
  if (epoxy_has_gl_extension("GL_MESA_pack_invert")) state["invert"] = {valueOf(GL_PACK_INVERT_MESA)};
  return state;
}

OwnContext::~OwnContext() {
  if (!m_context) return;
  GLboolean active = GL_FALSE;
  glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
  if (active == GL_TRUE) glEndTransformFeedback();
}

}  // namespace rubble::test
