#include "render/targets.h"

#include <array>

#include "gl/framebuffer.h"
#include "gl/raster.h"
#include "gl/texture.h"

namespace rubble::render {
namespace {

constexpr GLenum kColourFormat = GL_RGBA16F;  // light, before the tone curve
constexpr GLenum kDepthFormat = GL_DEPTH_COMPONENT32F;
constexpr GLenum kShadowFormat = GL_DEPTH_COMPONENT24;
constexpr float kFarthest = 1;

}  // namespace

ShadowMap::ShadowMap(int size) : m_size(size) {
  m_depth = gl::makeTexture2d({kShadowFormat, size, size, GL_LINEAR});
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  const std::array<float, 4> lit{1, 1, 1, 1};  // outside of the map nothing casts
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, lit.data());
  m_framebuffer = gl::makeFramebuffer("the shadow map", {}, m_depth.id(), 1);
}

void ShadowMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer.id());
  gl::setViewport(m_size, m_size);
  glClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void SceneTargets::resize(int width, int height) {
  if (width == m_width && height == m_height) return;
  m_colour = gl::makeTexture2d({kColourFormat, width, height});
  m_depth = gl::makeTexture2d({kDepthFormat, width, height});
  m_scene = gl::makeFramebuffer("the scene", std::array{m_colour.id()}, m_depth.id(), 1);
  if (m_samples > 1) {
    m_sampledColour = gl::makeTexture2d({kColourFormat, width, height, GL_NEAREST, m_samples});
    m_sampledDepth = gl::makeTexture2d({kDepthFormat, width, height, GL_NEAREST, m_samples});
    m_sampledScene = gl::makeFramebuffer("the multisampled scene", std::array{m_sampledColour.id()},
                                         m_sampledDepth.id(), m_samples);
  }
  const int halfWidth = (width + 1) / 2, halfHeight = (height + 1) / 2;
  m_dust = gl::makeTexture2d({GL_RGBA16F, halfWidth, halfHeight});
  m_dustDistance = gl::makeTexture2d({GL_R32F, halfWidth, halfHeight});
  m_dustFramebuffer = gl::makeFramebuffer("the dust", std::array{m_dust.id(), m_dustDistance.id()}, 0, 1);
  m_width = width;
  m_height = height;
}

void SceneTargets::beginScene() const {
  glBindFramebuffer(GL_FRAMEBUFFER, m_samples > 1 ? m_sampledScene.id() : m_scene.id());
  gl::setViewport(m_width, m_height);
  glClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void SceneTargets::resolve() const {
  if (m_samples <= 1) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, m_sampledScene.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_scene.id());
  glBlitFramebuffer(0, 0, m_width, m_height, 0, 0, m_width, m_height,
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void SceneTargets::beginDust() const {
  glBindFramebuffer(GL_FRAMEBUFFER, m_dustFramebuffer.id());
  gl::setViewport((m_width + 1) / 2, (m_height + 1) / 2);
}

}  // namespace rubble::render
