#include <fmt/format.h>

#include "choice.hpp"
#include "commands.hpp"
#include "moments.hpp"
#include "outputs.hpp"
#include "umbrage/report/write_profile.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::cli {
namespace {

struct ProfileOptions {
  SceneOptions scene;
  ViewOptions view;
  PlaceOptions place;
  std::chrono::milliseconds from{}, to{}, step{};
  std::string technique = "auto";
  std::string picture;
  bool noGround = false;
};

// The three figures: as shown by report::writeProfile.
Result<void> checkFiles(const std::string& picture, const std::string& scene) {
  if (const auto png = checkExtension("-o", picture, {".png"}); !png) return png;
  const std::string stem = picture.substr(0, picture.size() - std::string_view(".png").size());
  return checkOutputs({picture, stem + "-hours.png", stem + ".gif"}, scene);
}

Result<study::Profile> study(const ProfileOptions& options, const View& view, const Console& console) {
  const auto place = placeOf(options.place, view.scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  auto chosen = chooseTechnique(options.technique);
  if (!chosen) return tl::unexpected(chosen.error());
  console.detail(fmt::format("technique  {} ({})", chosen->technique->traits().name, chosen->reason));
  const study::Period period{*place, options.place.zone, options.place.date, options.from, options.to, options.step};
  return study::profile(view.scene, {period, view.camera, options.scene.casters}, *chosen->technique,
                        console.progress());
}

Result<std::vector<std::filesystem::path>> write(const ProfileOptions& options, const View& view,
                                                 const study::Profile& profile, const Console& console) {
  const DeferredSignals whole;
  const auto show = console.progress();
  const auto goOn = [&](double fraction, std::string_view what) {
    return (!show || show(fraction, what)) && !whole.pending();
  };
  return report::writeProfile(profile, view.scene, options.picture, goOn);
}

Result<Outcome> run(const ProfileOptions& options, const Console& console) {
  if (const auto open = checkFiles(options.picture, options.scene.file); !open) return tl::unexpected(open.error());
  // The study itself tells the casters apart, each pattern in its own colour.
  SceneOptions everything = options.scene;
  everything.casters.clear();
  auto scene = loadScene(everything, console);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto casts = checkCasts(*scene, options.scene); !casts) return tl::unexpected(casts.error());
  ViewOptions framed = options.view;
  if (options.noGround) framed.ground.reset();
  const auto view = makeView(std::move(*scene), framed);
  if (!view) return tl::unexpected(view.error());
  const auto profile = study(options, *view, console);
  if (!profile) return tl::unexpected(profile.error());
  for (const auto& warning : profile->warnings) console.warn(warning);
  const auto written = write(options, *view, *profile, console);
  if (!written) return tl::unexpected(written.error());
  std::string text;
  for (const auto& path : *written) text += path.string() + "\n";
  return Outcome{text, 0};
}

}  // namespace

Run addProfile(CLI::App& app) {
  const auto options = std::make_shared<ProfileOptions>();
  options->view.ground = Ground{};
  options->view.shadowRoom = 0.6;  // a day's shadows go to all sides
  const Manner time{.group = "Place and time", .required = true};
  addSceneOptions(app, options->scene);
  addWord(app, "-o,--output", "OUT.png",
          "The shadows of all steps; beside it OUT-hours.png (time in shadow) and OUT.gif", options->picture,
          {.required = true});
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addValue(app, "--from", "HH:MM", "The first moment", options->from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "The end of the period", options->to, sun::parseTime, time);
  addValue(app, "--step", "MIN", "Minutes from one moment to the next", options->step, parseStep, time);
  addValue(app, "--technique", "NAME|auto", "How shadows are computed (see umbrage techniques; default auto)",
           options->technique, parseTechnique);
  addCameraOptions(app, options->view);
  addAmbientOption(app, options->view);
  addGroundOption(app, options->view);
  addFlag(app, "--no-ground", "Leaves the ground out", options->noGround);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
