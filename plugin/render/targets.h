// The textures a frame is drawn into: shadow map, scene (multisampled and resolved), dust at half resolution.
#pragma once

#include "gl/name.h"

namespace rubble::render {

/// A depth texture seen from the sun, compared in hardware.
class ShadowMap {
 public:
  explicit ShadowMap(int size);
  /// Binds and clears it as the target of draws.
  void begin() const;
  GLuint texture() const { return m_depth.id(); }

 private:
  int m_size;
  gl::TextureName m_depth;
  gl::FramebufferName m_framebuffer;
};

/// Made anew when the size of the picture changes.
class SceneTargets {
 public:
  explicit SceneTargets(int samples) : m_samples(samples) {}

  void resize(int width, int height);
  void beginScene() const;
  /// Averages the samples; one sample's depth stands for the pixel.
  void resolve() const;
  void beginDust() const;

  GLuint colour() const { return m_colour.id(); }
  GLuint depth() const { return m_depth.id(); }
  GLuint dust() const { return m_dust.id(); }
  GLuint dustDistance() const { return m_dustDistance.id(); }

 private:
  int m_samples;
  int m_width = 0, m_height = 0;
  gl::TextureName m_colour, m_depth, m_sampledColour, m_sampledDepth, m_dust, m_dustDistance;
  gl::FramebufferName m_scene, m_sampledScene, m_dustFramebuffer;
};

}  // namespace rubble::render
