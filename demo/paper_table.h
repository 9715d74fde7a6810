// Table 1 of the paper, "Performance under various settings": T. Imagire, H. Johan, T. Nishita, "A Fast
// Method for Simulating Destruction and the Generated Dust and Debris", The Visual Computer 25 (2009),
// section 5.
#pragma once

#include <array>
#include <string_view>

namespace rubble::demo {

/// One cell of the table. Its settings are those of the line but for the one that its part changes.
struct PaperCell {
  char part;                    ///< 'a' to 'd'
  int width = 1280;             ///< of the screen [pixels]
  int height = 720;             ///< [pixels]
  int elements = 2048;          ///< of the EDEM
  int dust = 64;                ///< cells of the fluid grid along each axis
  double fps;                   ///< frames a second
  bool pictures = part != 'd';  ///< (d) is "without rendering"
};

inline constexpr std::array<PaperCell, 18> kPaperTable = {{
    // (a) Screen resolution
    {.part = 'a', .width = 320, .height = 180, .fps = 9.0},
    {.part = 'a', .width = 640, .height = 360, .fps = 8.9},
    {.part = 'a', .width = 960, .height = 540, .fps = 8.9},
    {.part = 'a', .width = 1280, .height = 720, .fps = 8.8},
    // (b) Number of EDEM elements
    {.part = 'b', .elements = 128, .fps = 11.0},
    {.part = 'b', .elements = 256, .fps = 10.7},
    {.part = 'b', .elements = 512, .fps = 10.7},
    {.part = 'b', .elements = 1024, .fps = 10.6},
    {.part = 'b', .elements = 2048, .fps = 8.8},
    // (c) Resolution of fluid simulation
    {.part = 'c', .dust = 8, .fps = 9.1},
    {.part = 'c', .dust = 16, .fps = 9.1},
    {.part = 'c', .dust = 32, .fps = 9.0},
    {.part = 'c', .dust = 64, .fps = 8.8},
    // (d) Number of EDEM elements (without rendering)
    {.part = 'd', .elements = 128, .fps = 320},
    {.part = 'd', .elements = 256, .fps = 160},
    {.part = 'd', .elements = 512, .fps = 75},
    {.part = 'd', .elements = 1024, .fps = 30},
    {.part = 'd', .elements = 2048, .fps = 9.1},
}};

/// A figure of section 5 and the scene here that shows it. The text gives the speed of figure 6 alone: "0.5
/// fps. If we do not use the advected textures [...], the performance is up to 8.8 fps"; there are none here.
struct PaperFigure {
  std::string_view name;
  std::string_view scene;
  double fps = 0;  ///< with pictures; 0: not told
};

inline constexpr std::array<PaperFigure, 3> kPaperFigures = {{
    {.name = "figure 6", .scene = "wall", .fps = 8.8},
    {.name = "figure 7", .scene = "two_fragile"},
    {.name = "figure 8", .scene = "column"},
}};

/// The scene of the table. The paper does not name it; its largest settings and their 8.8 fps are figure 6's.
inline constexpr std::string_view kPaperTableScene = "wall";

inline constexpr std::string_view kPaperMachine =
    "Intel Core 2 Extreme X6800 2.93 GHz (2 cores, OpenMP), NVIDIA GeForce 8800 GTX, Direct3D 10";

}  // namespace rubble::demo
