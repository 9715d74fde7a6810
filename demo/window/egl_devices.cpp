#include "demo/window/egl_devices.h"

namespace rubble::demo {

bool isSoftwareDevice(const EglDevice& device) {
  // Whole words: an extension's name may begin with another's.
  return (" " + device.extensions + " ").find(" EGL_MESA_device_software ") != std::string::npos;
}

std::vector<EglDisplayChoice> displayChoices(std::span<const EglDevice> devices, bool hasSurfaceless) {
  std::vector<EglDisplayChoice> choices;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!isSoftwareDevice(devices[i])) choices.push_back({EglDisplayChoice::Kind::Device, i});
  }
  if (hasSurfaceless) choices.push_back({EglDisplayChoice::Kind::Surfaceless});
  choices.push_back({EglDisplayChoice::Kind::Default});
  return choices;
}

}  // namespace rubble::demo
