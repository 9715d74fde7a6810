// Offscreen target of headless runs.
#include <algorithm>
#include <array>

#include "gl/capabilities.h"
#include "gl/error.h"
#include "gl/framebuffer.h"
#include "gl/guest.h"
#include "gl/texture.h"
#include "rubble/render.h"

namespace rubble {

struct Framebuffer::Impl {
  gl::Capabilities capabilities;
  int width, height;
  gl::TextureName colour, depth;
  gl::FramebufferName framebuffer;
};

Framebuffer::Framebuffer(int width, int height) : m_impl(std::make_unique<Impl>()) {
  m_impl->capabilities = gl::capabilitiesNow("Framebuffer");
  const gl::Guest guest(m_impl->capabilities);
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (width < 1 || height < 1 || width > most || height > most) {
    throw Error("Framebuffer: " + std::to_string(width) + " x " + std::to_string(height) + " pixels, 1 to " +
                std::to_string(most) + " allowed");
  }
  m_impl->width = width;
  m_impl->height = height;
  m_impl->colour = gl::makeTexture2d({GL_RGBA8, width, height});
  m_impl->depth = gl::makeTexture2d({GL_DEPTH_COMPONENT24, width, height});
  m_impl->framebuffer =
      gl::makeFramebuffer("a picture", std::array{m_impl->colour.id()}, m_impl->depth.id(), 1);
}

Framebuffer::~Framebuffer() = default;
Framebuffer::Framebuffer(Framebuffer&&) noexcept = default;
Framebuffer& Framebuffer::operator=(Framebuffer&&) noexcept = default;

FrameTarget Framebuffer::target() const {
  return {m_impl->framebuffer.id(), m_impl->width, m_impl->height};
}

Image Framebuffer::readPixels() const {
  Image image{m_impl->width, m_impl->height, {}};
  const std::size_t row = std::size_t{4} * std::size_t(image.width);
  image.pixels.resize(row * std::size_t(image.height));
  const gl::Guest guest(m_impl->capabilities);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, m_impl->framebuffer.id());
  glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  gl::checkGl("reading a picture");
  // OpenGL's first row is the lowest.
  const auto rowAt = [&](int y) { return image.pixels.begin() + std::ptrdiff_t(row) * y; };
  for (int y = 0; y < image.height / 2; ++y) {
    std::swap_ranges(rowAt(y), rowAt(y + 1), rowAt(image.height - 1 - y));
  }
  return image;
}

}  // namespace rubble
