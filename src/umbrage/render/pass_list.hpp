#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/gl/pass_state.hpp"
#include "umbrage/render/volume_options.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

enum class Target { surface, tiles, stencil, mask, sum, picture, host };
/// Of volumes: `volume` and `finiteVolume` from doubled vertices, `carriedVolume` from LightVolume::points, .. `Sides` from edges by a geometry shader.
enum class Shader {
  none,
  surface,
  largeSurface,
  receiverTiles,
  volume,
  finiteVolume,
  carriedVolume,
  volumeSides,
  finiteVolumeSides,
  keepShadow,
  lightMask,
  ambient,
  light,
  maskedLight,
  encode
};
/// What is drawn: nothing, the surfaces (those that reach far apart), a part of a light's volumes, one triangle over the whole target.
enum class Draw { nothing, surfaces, largeSurfaces, nearCasters, passSides, failSides, turnedSides, failCaps, screen };

/// One pass as plain data.
struct PassStep {
  std::string name;
  std::string phase;  ///< what its time is booked on
  Target target = Target::surface;
  Shader shader = Shader::none;
  Draw draw = Draw::nothing;
  int light = -1;            ///< whose data it uses; -1: no light's
  int group = 0;             ///< which group of the light's volumes it draws
  bool clearColour = false;  ///< to no triangle, or black
  std::optional<float> clearDepth;
  std::optional<std::uint8_t> clearStencil;
  gl::PassState state;
};

/// A whole frame as plain data: what is drawn, into what, in which state.
struct PassList {
  std::vector<PassStep> steps;
};

/// One line a pass.
[[nodiscard]] std::string describe(const PassList& list);

/// What is counted together.
struct GroupPlan {
  int eyeCount = 0;          ///< the stencil starts from it, wrapped into the bits that count
  bool nearCasters = false;  ///< what lies between the near rectangle and the light is counted first, by drawing it
  bool passSides = false, failSides = false, failCaps = false;  ///< which parts of the volumes are not empty
  bool turnedSides = false;
};

/// What the plan must know of one light.
struct LightPlan {
  std::vector<GroupPlan> groups{
      1};  ///< several share the stencil: 7 bits count, the eighth keeps what earlier groups found
  /// Caps are compared with the depth, for casters that are not in the depth buffer themselves (drawn later, or transparent);
  /// where they are, that would make caps fight with the surfaces they lie on.
  bool compareCaps = false;
  bool twoSided = true;  ///< false: a pass for each face
  shadow::Extrusion extrusion = shadow::Extrusion::vertexShader;
  bool finite = false;  ///< the volumes' ends are given (LightVolume::farPoints)
  gl::Rect volumeArea, litArea;
  Overflow overflow = Overflow::none;
  std::optional<std::array<float, 2>>
      depthBounds;  ///< outside of them no volume needs to be drawn (render::depthBounds)
};

enum class Product {
  masks,        ///< what the camera sees, and a light mask per light
  picture,      ///< the lit picture: ambient, then every light added, then encoded
  hostStencil,  ///< the first light's shadows in the stencil of a host's own framebuffer, over the host's depth
};

/// Plans what comes before the lights: the surfaces that the camera sees. `placement`: viewport, clip control, depth range and
/// front-face sense for everything drawn in perspective.
[[nodiscard]] PassList planSurfaces(const gl::PassState& placement, bool reversed);

/// Plans how far the receivers of a light are, for ReceiverTiles. `tiles`: how many there are.
[[nodiscard]] PassList planTiles(int light, const gl::Rect& tiles);

/// Plans the lights, and what is made of them. REQUIRES: planSurfaces() has been run, but for Product::hostStencil.
[[nodiscard]] PassList planLights(const gl::PassState& placement, bool reversed, const std::vector<LightPlan>& lights,
                                  Product product);

// The pieces of it for techniques that find shadows in ways of their own.

/// The mask of a light inside `litArea`, black elsewhere: white where the surface faces it and the stencil has none of the bits `shadow`.
[[nodiscard]] PassList planMask(const gl::PassState& placement, int light, const gl::Rect& litArea,
                                std::uint8_t shadow);
/// The picture from the first `lights` masks.
[[nodiscard]] PassList planMaskedPicture(const gl::PassState& placement, int lights);

}  // namespace umbrage::render
