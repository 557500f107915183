#include "drawing.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

namespace umbrage::cli {
namespace {

constexpr double kEnoughMs = 3000.0;  // for the frames of one technique

shadow::Frame frameOf(const View& view) {
  return {.camera = view.camera,
          .lights = view.lights,
          .silhouettes = view.silhouettes,
          .fill = view.fill,
          .extrusion = view.extrusion,
          .veilLayers = view.veilLayers,
          .soft = view.soft,
          .detailed = view.detailed};
}

Result<void> checkLights(const shadow::Traits& traits, const View& view) {
  if (traits.soft || !std::ranges::any_of(view.lights, scene::isArea)) return {};
  return fail(
      ErrorCode::usage,
      fmt::format("{} knows no lights with an extent (soft shadows): use soft_cpu, soft_rays or auto", traits.name));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The first frame also makes what lasts (shaders, memory), so where there are more it is not timed.
Result<void> shade(shadow::Technique& technique, const shadow::Frame& frame, std::size_t frames, Drawing& drawing) {
  Stopwatch watch;
  std::vector<double> times;
  double spent = 0.0;
  do {
    auto shading = technique.shade(frame);
    if (!shading) return tl::unexpected(shading.error());
    drawing.shading = std::move(*shading);
    times.push_back(watch.lap());
    spent += times.back();
  } while (times.size() <= frames && frames > 1 && spent < kEnoughMs);
  if (times.size() > 1) times.erase(times.begin());
  drawing.frames = times.size();
  drawing.shadeMs = median(std::move(times));
  return {};
}

}  // namespace

Result<Drawing> draw(const std::string& technique, const std::shared_ptr<const shadow::Geometry>& geometry,
                     const View& view, const Console& console, const DrawOptions& options) {
  const Stage stage(console, fmt::format("shading with {}", technique));
  Drawing drawing;
  Stopwatch watch;
  auto chosen = chooseTechnique(
      technique, {!geometry->filters.empty(), std::ranges::any_of(view.lights, scene::isArea)}, view.techniques);
  if (!chosen) return tl::unexpected(chosen.error());
  drawing.traits = chosen->technique->traits();
  if (const auto known = checkLights(drawing.traits, view); !known && !options.areasAsCentres)
    return tl::unexpected(known.error());
  drawing.reason = chosen->reason;
  drawing.renderer = chosen->renderer;
  drawing.createMs = watch.lap();
  if (const auto prepared = chosen->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
  drawing.prepareMs = watch.lap();
  if (const auto done = shade(*chosen->technique, frameOf(view), options.frames, drawing); !done)
    return tl::unexpected(done.error());
  return drawing;
}

std::vector<std::string> maskFiles(const std::string& path, std::size_t lights) {
  if (lights == 1) return {path};
  const std::filesystem::path file(path);
  std::vector<std::string> files;
  for (std::size_t i = 0; i < lights; ++i)
    files.push_back(
        (file.parent_path() / fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string())).string());
  return files;
}

}  // namespace umbrage::cli
