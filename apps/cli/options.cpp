#include "options.hpp"

#include <fmt/format.h>

namespace umbrage::cli {
namespace {

Result<std::string> nonEmpty(const std::string& word) {
  if (word.empty()) return fail(ErrorCode::usage, "is empty");
  return word;
}

Result<Angle> parseDegrees(const std::string& word, double low, double high) {
  const auto value = parseNumber(word, low, high);
  if (!value) return tl::unexpected(value.error());
  return Angle::degrees(*value);
}

Result<Ground> parseGround(const std::string& word) {
  if (word == "lowest") return Ground{};
  const auto height = parseNumber(word, -1e12, 1e12);
  if (!height)
    return fail(ErrorCode::usage, height.error().message + " (a height, or nothing for the scene's lowest point)");
  return Ground{*height};
}

}  // namespace

CLI::Option* addWord(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
                     std::string& target) {
  return addValue(app, name, form, help, target, nonEmpty);
}

void addSceneOptions(CLI::App& app, SceneOptions& options) {
  addWord(app, "SCENE", "", "A scene file, or sample:NAME", options.file)->required();
  addValue(app, "--up", "y|z", "The axis that points to the sky (default: the format's)", options.up, parseUp)
      ->group("Scene");
  addValue(app, "--north", "DEG", "True north lies DEG clockwise of the frame's north", options.north,
           [](const std::string& word) { return parseDegrees(word, -360, 360); })
      ->group("Scene");
  addValue(app, "--unit", "m|cm|mm|ft|in", "What one unit of the file is (default: the file's own, or m)",
           options.metresPerUnit, parseUnit)
      ->group("Scene");
  addValue(app, "--lod", "LOD", "Level of detail of a CityJSON file (default: the highest)", options.lod, nonEmpty)
      ->group("Scene");
  addParsed(app, "--casters", "PATTERN", "Only parts with such a name cast shadows ('*' and '?' allowed; repeatable)",
            nonEmpty, [&options](const std::string& word) { options.casters.push_back(word); })
      ->take_all()
      ->group("Scene");
}

void addCameraOptions(CLI::App& app, ViewOptions& options) {
  addValue(app, "--eye", "X,Y,Z", "Where the camera is (default: the whole scene from the south-west at 30 degrees)",
           options.eye, parsePoint)
      ->group("Picture");
  addValue(app, "--target", "X,Y,Z", "What the camera looks at (default: the scene's centre)", options.target,
           parsePoint)
      ->group("Picture");
  addValue(app, "--fov", "DEG", "Vertical field of view, 1 to 170 (default 45)", options.fov,
           [](const std::string& word) { return parseDegrees(word, 1, 170); })
      ->group("Picture");
  addValue(app, "--size", "WxH", "Size of the picture in pixels (default 1280x720)", options.size, parseSize)
      ->group("Picture");
  addValue(app, "--ambient", "A", "Light from everywhere, 0 to 1 (default 0.25)", options.ambient,
           [](const std::string& word) { return parseNumber(word, 0, 1); })
      ->group("Picture");
}

void addLightOptions(CLI::App& app, ViewOptions& options) {
  addParsed(
      app, "--light", "SPEC",
      "point:x,y,z, directional:dx,dy,dz or spot:x,y,z,dx,dy,dz,CUTOFF_DEG, each with optional ,#rrggbb[,intensity]; "
      "repeatable (default: the file's lights, else a sun)",
      parseLight, [&options](const scene::Light& light) { options.lights.push_back(light); })
      ->take_all()
      ->group("Picture");
}

void addGroundOption(CLI::App& app, ViewOptions& options) {
  addValue(app, "--ground", "[HEIGHT]",
           "Adds a large ground that casts nothing (default height: the scene's lowest point)", options.ground,
           parseGround)
      ->group("Picture");
}

}  // namespace umbrage::cli
