#include "drawing.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace umbrage::cli {

Result<Drawing> draw(const std::string& technique, const std::shared_ptr<const shadow::Geometry>& geometry,
                     const View& view, const Console& console) {
  const Stage stage(console, fmt::format("shading with {}", technique));
  Drawing drawing;
  Stopwatch watch;
  auto chosen = chooseTechnique(
      technique, {!geometry->filters.empty(), std::ranges::any_of(view.lights, scene::isArea)}, view.techniques);
  if (!chosen) return tl::unexpected(chosen.error());
  drawing.traits = chosen->technique->traits();
  if (!drawing.traits.soft && std::ranges::any_of(view.lights, scene::isArea))
    return fail(ErrorCode::usage,
                fmt::format("{} knows no lights with an extent (soft shadows): use soft_cpu, soft_rays or auto",
                            drawing.traits.name));
  drawing.reason = chosen->reason;
  drawing.renderer = chosen->renderer;
  drawing.createMs = watch.lap();
  if (const auto prepared = chosen->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
  drawing.prepareMs = watch.lap();
  auto shading = chosen->technique->shade({.camera = view.camera,
                                           .lights = view.lights,
                                           .silhouettes = view.silhouettes,
                                           .fill = view.fill,
                                           .extrusion = view.extrusion,
                                           .veilLayers = view.veilLayers,
                                           .soft = view.soft,
                                           .detailed = view.detailed});
  if (!shading) return tl::unexpected(shading.error());
  drawing.shadeMs = watch.lap();
  drawing.shading = std::move(*shading);
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
