#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "console.hpp"
#include "parse.hpp"
#include "umbrage/base/angle.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::cli {

/// What a command does once its words are read.
using Run = std::function<Result<Outcome>(const Console&)>;

/// An option with one value that `parse` (word -> Result<T>) turns into a T; its message is shown after the option's
/// name. Repeatable when `take` says so.
template <class Parse, class Take>
CLI::Option* addParsed(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
                       Parse parse, Take take) {
  CLI::Option* option = app.add_option(
      name, [](const CLI::results_t&) { return true; }, help);
  option->type_name(form)->expected(1)->allow_extra_args(false);
  option->check(CLI::Validator(
      [parse, take](std::string& word) -> std::string {
        const auto value = parse(word);
        if (!value) return value.error().message;
        take(*value);
        return {};
      },
      ""));
  return option;
}

template <class T, class Parse>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
                      T& target, Parse parse) {
  return addParsed(app, name, form, help, parse, [&target](const auto& value) { target = value; });
}

/// A plain word, for example a path; never empty.
CLI::Option* addWord(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
                     std::string& target);

/// Which scene, and how its file is to be understood.
struct SceneOptions {
  std::string file;
  std::optional<scene::UpAxis> up;
  std::optional<double> metresPerUnit;
  std::optional<Angle> north;
  std::optional<std::string> lod;
  std::vector<std::string> casters;  ///< patterns of the parts that cast; empty: all
};
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// A file, or "sample:NAME". Errors: usage, when no part has a name that `casters` asks for.
[[nodiscard]] Result<scene::Scene> loadScene(const SceneOptions& options);
/// The same, its warnings shown on the console.
[[nodiscard]] Result<scene::Scene> loadScene(const SceneOptions& options, const Console& console);

/// `--ground`: at a height, or at the scene's lowest point.
struct Ground {
  std::optional<double> height;
};

/// How the scene is looked at and lit.
struct ViewOptions {
  std::optional<Vec3> eye, target;
  Angle fov = Angle::degrees(45);
  Size size;
  std::optional<Ground> ground;
  std::vector<scene::Light> lights;
  double ambient = 0.25;
};
void addCameraOptions(CLI::App& app, ViewOptions& options);
void addLightOptions(CLI::App& app, ViewOptions& options);
void addGroundOption(CLI::App& app, ViewOptions& options);

/// The scene as it is drawn, and why it is looked at and lit so.
struct View {
  scene::Scene scene;
  scene::Camera camera;
  std::vector<scene::Light> lights;
  std::string cameraReason;
  std::string lightReason;
};
/// Errors: usage, when eye and target coincide or the picture with so many lights does not fit into memory.
[[nodiscard]] Result<View> makeView(scene::Scene scene, const ViewOptions& options);

}  // namespace umbrage::cli
