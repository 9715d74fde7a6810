// Which of a machine's EGL displays a headless run draws on. No EGL here: the choice is made on a
// description.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rubble::demo {

/// A device as EGL_EXT_device_enumeration lists it.
struct EglDevice {
  std::string extensions;  ///< of the device, separated by blanks
};

/// A way to open a display.
struct EglDisplayChoice {
  enum class Kind { Device, Surfaceless, Default };
  Kind kind = Kind::Default;
  std::size_t device = 0;  ///< place in the list of devices, for Kind::Device
  bool operator==(const EglDisplayChoice&) const = default;
};

/// True for devices that draw on the processor: those with EGL_MESA_device_software.
bool isSoftwareDevice(const EglDevice& device);

/// What to try, best first: the devices that are hardware in the driver's order, Mesa's surfaceless platform
/// where there is one (hardware of Mesa's if it has any, else software), the default display.
std::vector<EglDisplayChoice> displayChoices(std::span<const EglDevice> devices, bool hasSurfaceless);

}  // namespace rubble::demo
