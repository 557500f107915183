#pragma once

#include <span>
#include <string>
#include <vector>

#include "technique_options.hpp"
#include "umbrage/shadow/technique.hpp"

// What a build without OpenGL has not got; the only file that knows whether it has.
namespace umbrage::cli {

/// What the OpenGL techniques would run on.
struct Graphics {
  std::string renderer;   ///< the GL renderer string; empty: no graphics
  bool software = false;  ///< it runs on the CPU
  std::string reason;     ///< why there is none
};
[[nodiscard]] Graphics findGraphics();

/// The techniques that run on OpenGL.
[[nodiscard]] std::vector<shadow::TechniqueEntry> graphicsTechniques(const TechniqueOptions& options);

/// `picture` with shadow volumes ("volumes") and their edges ("silhouette") drawn over it. Errors: device.
[[nodiscard]] Result<image::RgbImage> drawOver(const image::RgbImage& picture, const std::vector<std::string>& what,
                                               const shadow::Geometry& geometry, const shadow::Frame& frame);

}  // namespace umbrage::cli
