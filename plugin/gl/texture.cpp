#include "gl/texture.h"

#include "gl/error.h"

namespace rubble::gl {
namespace {

TextureName makeTexture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return TextureName(id);
}

}  // namespace

TextureName makeTexture2d(const TextureDef& def) {
  TextureName texture = makeTexture();
  if (def.samples > 1) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.id());
    glTexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, def.samples, def.format, def.width, def.height,
                              GL_TRUE);
  } else {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, def.format, def.width, def.height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GLint(def.filter));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GLint(def.filter));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  checkGl("a texture");
  return texture;
}

TextureName makeVolume(const VolumeDef& def) {
  TextureName texture = makeTexture();
  glBindTexture(GL_TEXTURE_3D, texture.id());
  glTexStorage3D(GL_TEXTURE_3D, def.levels, def.format, def.size, def.size, def.size);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER,
                  def.levels > 1 ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GLint(def.edges[0]));
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_T, GLint(def.edges[1]));
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_R, GLint(def.edges[2]));
  glTexParameterfv(GL_TEXTURE_3D, GL_TEXTURE_BORDER_COLOR, def.border.data());
  checkGl("a volume of texels");
  return texture;
}

}  // namespace rubble::gl
