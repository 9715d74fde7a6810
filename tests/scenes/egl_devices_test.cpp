// The choice of what a headless run draws on, for machines that are only described.
#include "demo/window/egl_devices.h"

#include <gtest/gtest.h>

namespace rubble::test {
namespace {

using demo::EglDevice;
using Choice = demo::EglDisplayChoice;
using Kind = Choice::Kind;
using Choices = std::vector<Choice>;

// As the drivers describe themselves: NVIDIA 535, Mesa 22.3 with a card, Mesa's llvmpipe.
const EglDevice kNvidia{"EGL_NV_device_cuda EGL_EXT_device_drm EGL_EXT_device_drm_render_node"};
const EglDevice kMesaCard{"EGL_EXT_device_drm EGL_EXT_device_drm_render_node"};
const EglDevice kLlvmpipe{"EGL_MESA_device_software EGL_EXT_device_drm_render_node"};

TEST(EglDevices, HardwareComesFirstInTheDriversOrder) {
  const std::vector<EglDevice> devices = {kLlvmpipe, kNvidia, kMesaCard};
  EXPECT_EQ(demo::displayChoices(devices, true),
            (Choices{{Kind::Device, 1}, {Kind::Device, 2}, {Kind::Surfaceless}, {Kind::Default}}));
}

TEST(EglDevices, WithoutHardwareMesaDrawsSurfaceless) {
  const std::vector<EglDevice> devices = {kLlvmpipe};
  EXPECT_EQ(demo::displayChoices(devices, true), (Choices{{Kind::Surfaceless}, {Kind::Default}}));
}

TEST(EglDevices, WithoutMesaAndListTheDefaultDisplayIsLeft) {
  EXPECT_EQ(demo::displayChoices({}, false), (Choices{{Kind::Default}}));
}

TEST(EglDevices, SoftwareIsAWholeWord) {
  EXPECT_TRUE(demo::isSoftwareDevice({"EGL_MESA_device_software"}));
  EXPECT_FALSE(demo::isSoftwareDevice({"EGL_MESA_device_software_not"}));
  EXPECT_FALSE(demo::isSoftwareDevice({""}));
}

}  // namespace
}  // namespace rubble::test
