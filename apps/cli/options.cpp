#include "options.hpp"

#include <cmath>

#include <fmt/format.h>

#include "umbrage/io/load.hpp"
#include "umbrage/shadow/veil_layers.hpp"

namespace umbrage::cli {
namespace {

constexpr Manner kScene{.group = "Scene"};
constexpr Manner kPicture{.group = "Picture"};

Result<Ground> parseGround(const std::string& word) {
  if (word == "lowest") return Ground{};
  const auto height = parseNumber(word, -1e12, 1e12);
  if (!height)
    return fail(ErrorCode::usage, height.error().message + " (a height, or nothing for the scene's lowest point)");
  return Ground{*height};
}

Result<shadow::VolumeFill> parseFill(const std::string& word) {
  if (word == "reduced") return shadow::VolumeFill::reduced;
  if (word == "plain") return shadow::VolumeFill::plain;
  return fail(ErrorCode::usage, fmt::format("'{}' is neither reduced nor plain", word));
}

Result<shadow::Extrusion> parseExtrusion(const std::string& word) {
  if (word == "cpu") return shadow::Extrusion::processor;
  if (word == "vertex") return shadow::Extrusion::vertexShader;
  if (word == "geometry") return shadow::Extrusion::geometryShader;
  return fail(ErrorCode::usage, "must be one of cpu, vertex, geometry");
}

// parseNumber, parseDegrees with their limits.
auto numberIn(double low, double high) {
  return [low, high](const std::string& word) { return parseNumber(word, low, high); };
}
auto degreesIn(double low, double high) {
  return [low, high](const std::string& word) { return parseDegrees(word, low, high); };
}

Result<std::size_t> parseSamples(std::string_view word) {
  const auto number = parseNumber(word, 1, 65536);
  if (!number || *number != std::floor(*number))
    return fail(ErrorCode::usage, "must be a whole number from 1 to 65536");
  return static_cast<std::size_t>(*number);
}

Result<std::size_t> parseCount(std::string_view word) {
  const auto number = parseNumber(word, 0, io::kMaxTriangles);
  if (!number || *number != std::floor(*number)) return fail(ErrorCode::usage, "must be a whole number");
  return static_cast<std::size_t>(*number);
}

Result<std::optional<int>> parseVeilLayers(std::string_view word) {
  if (word == "all") return std::optional<int>();
  if (word == "auto") return std::optional(shadow::kVeilLayersThatMatter);
  const auto number = parseNumber(word, 0, 1000);
  if (!number || *number != std::floor(*number))
    return fail(ErrorCode::usage, "must be a whole number from 0 to 1000, all or auto");
  return std::optional(static_cast<int>(*number));
}

}  // namespace

void addSceneOptions(CLI::App& app, SceneOptions& options) {
  addWord(app, "SCENE", "", "A scene file, or sample:NAME", options.file, {.required = true});
  addValue(app, "--up", "y|z", "The axis that points to the sky (default: the format's)", options.up, parseUp, kScene);
  const auto north = [&options](const std::string& word) -> Result<std::optional<Angle>> {
    options.trueNorth = word == "true";
    if (options.trueNorth) return std::optional<Angle>();
    const auto angle = parseDegrees(word, -360, 360);
    if (!angle) return tl::unexpected(angle.error());
    return std::optional(*angle);
  };
  addValue(app, "--north", "DEG|true",
           "True north lies DEG clockwise of the frame's north; true: as the file's reference system says",
           options.north, north, kScene);
  addValue(app, "--unit", "m|cm|mm|ft|in", "What one unit of the file is (default: the file's own, or m)",
           options.metresPerUnit, parseUnit, kScene);
  addValue(app, "--lod", "LOD", "Level of detail of a CityJSON file (default: the highest)", options.lod, parseWord,
           kScene);
  addValue(app, "--crs", "EPSG:CODE|local",
           "What the coordinates are, instead of what the file says; local: metres of no place in particular",
           options.crs, parseWord, kScene);
  addValue(app, "--height-property", "NAME", "Footprints: the property that is the height, in metres",
           options.heightProperty, parseWord, kScene);
  addValue(app, "--default-height", "M", "Footprints: the height of those that have none", options.defaultHeight,
           numberIn(0.01, 1000), kScene);
  addValue(app, "--floor-height", "M", "Footprints: from floor to floor, where only floors are known (default 3)",
           options.floorHeight, numberIn(0.1, 100), kScene);
  addValue(app, "--alpha-triangles", "N",
           "glTF: textures with alpha may cut triangles into so many pieces; 0: none (default 250000)",
           options.alphaTriangles, parseCount, kScene);
  addValue(app, "--alpha-texels", "N", "glTF: along cells of N x N texels, a power of two (default 1)",
           options.alphaTexels, parseCount, kScene);
  addValues(app, "--casters", "PATTERN", "Only parts with such a name cast shadows ('*' and '?' allowed; repeatable)",
            options.casters, parseWord, kScene);
}

void addCameraOptions(CLI::App& app, ViewOptions& options) {
  addValue(app, "--eye", "X,Y,Z", "Where the camera is (default: the whole scene from the south-west at 30 degrees)",
           options.eye, parsePoint, kPicture);
  addValue(app, "--target", "X,Y,Z", "What the camera looks at (default: the scene's centre)", options.target,
           parsePoint, kPicture);
  addValue(app, "--fov", "DEG", "Vertical field of view, 1 to 170 (default 45)", options.fov, degreesIn(1, 170),
           kPicture);
  addValue(app, "--size", "WxH", "Size of the picture in pixels (default 1280x720)", options.size, parseSize, kPicture);
}

void addAmbientOption(CLI::App& app, ViewOptions& options) {
  addValue(app, "--ambient", "A", "Light from everywhere, 0 to 1 (default 0.25)", options.ambient, numberIn(0, 1),
           kPicture);
}

void addAntialiasOption(CLI::App& app, ViewOptions& options) {
  const auto parse = [](std::string_view word) -> Result<int> {
    const auto number = parseNumber(word, 1, 8);
    if (!number) return tl::unexpected(number.error());
    if (*number != std::floor(*number)) return fail(ErrorCode::usage, "must be a whole number, for example 2");
    return static_cast<int>(*number);
  };
  addValue(app, "--antialias", "N", "Smooth edges: N x N samples a pixel of the picture, 1 to 8 (default 1)",
           options.antialias, parse);
}

void addLightOptions(CLI::App& app, ViewOptions& options) {
  addValues(app, "--light", "SPEC",
            "point:x,y,z, directional:dx,dy,dz (the way the light travels), spot:x,y,z,dx,dy,dz,CUTOFF_DEG; with soft "
            "shadows disc:x,y,z,dx,dy,dz,RADIUS, "
            "rect:x,y,z,ux,uy,uz,vx,vy,vz (centre and half sides; shines along u x v), sphere:x,y,z,RADIUS, "
            "sun:dx,dy,dz,DIAMETER_DEG; each with an "
            "optional ,#rrggbb[,intensity]; repeatable (default: the file's lights, else a sun)",
            options.lights, parseLight, kPicture);
  addValue(app, "--samples", "N", "So many points of each light with an extent, 1 to 65536 (default 64)",
           options.soft.samples, parseSamples, kPicture);
  addValue(
      app, "--soft-error", "E",
      "Takes no more points than it needs for an estimated error of E, for example 0.01 (default 0: all)",
      options.soft.enough, [](std::string_view word) { return parseNumber(word, 0.0, 1.0); }, kPicture);
}

void addGroundOption(CLI::App& app, ViewOptions& options) {
  addValue(app, "--ground", "[HEIGHT]",
           "Adds a large ground that casts nothing (default height: the scene's lowest point)", options.ground,
           parseGround, kPicture);
}

void addSilhouetteOption(CLI::App& app, ViewOptions& options) {
  addValue(app, "--silhouette", "NAME|auto",
           "How shadow volumes find their silhouettes; changes times, no pixel (default auto)", options.silhouettes,
           parseFinder, kPicture);
  addValue(app, "--volume-fill", "reduced|plain",
           "Whether shadow volumes leave out what changes no pixel; changes times, no pixel (default reduced)",
           options.fill, parseFill, kPicture);
  addValue(app, "--extrude", "cpu|vertex|geometry",
           "Who carries shadow volumes away from the light: the processor, a vertex or a geometry shader; changes "
           "times, no pixel (default vertex)",
           options.extrusion, parseExtrusion, kPicture);
}

void addVeilOption(CLI::App& app, ViewOptions& options) {
  addValue(app, "--veil-layers", "N|all|auto",
           "So many surfaces of a pixel that let light through, the nearest, have the shadows of others on them; 0: "
           "none (faster); auto: those through which 1/255 of what is behind is seen (default all)",
           options.veilLayers, parseVeilLayers, kPicture);
  addValue(
      app, "--see-through", "OPACITY",
      "Every surface of the scene is at most so opaque, for example 0.3: its shadow shows what is inside",
      options.seeThrough, [](std::string_view word) { return parseNumber(word, 0.0, 1.0); }, kPicture);
}

}  // namespace umbrage::cli
