#include "stats.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "json.hpp"
#include "umbrage/io/load.hpp"
#include "umbrage/shadow/veil_layers.hpp"

namespace umbrage::cli {
namespace {

std::size_t count(const image::GreyImage& image, std::uint8_t value) {
  return static_cast<std::size_t>(std::count(image.pixels().begin(), image.pixels().end(), value));
}

std::size_t coveredPixels(const shadow::SurfaceBuffer& seen) {
  const auto pixels = seen.triangle.pixels();
  return seen.triangle.size() - static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), shadow::kNoTriangle));
}

Json castersJson(const shadow::CasterSet& casters) {
  return {{"triangles", casters.triangles.size()},      {"edges", casters.edges.size()},
          {"border_edges", casters.report.borderEdges}, {"non_manifold_edges", casters.report.nonManifoldEdges},
          {"components", casters.componentCount},       {"topology", mesh::name(casters.report.topology)}};
}

/// How many parts of the scene are named for one choice.
constexpr std::size_t kNamed = 8;

/// The part of the scene that a connected component of the casters belongs to (the first, where parts touch).
std::vector<std::string_view> partNames(const scene::Scene& scene, const shadow::Geometry& geometry) {
  const shadow::CasterSet& casters = geometry.casters;
  std::vector<std::string_view> names(casters.componentCount);
  for (std::size_t t = casters.triangles.size(); t-- > 0;)
    names[casters.componentOf[t]] = scene.instances[geometry.surfaces.instances[casters.surfaceTriangle[t]]].name;
  return names;
}

/// The first casters of one choice, one of each part of the scene.
Json firstOf(shadow::CasterChoice choice, const std::vector<shadow::CasterChoice>& choices,
             const std::vector<std::string_view>& names) {
  Json first = Json::array();
  std::set<std::string_view> named;
  for (std::size_t c = 0; c < choices.size() && first.size() < kNamed; ++c)
    if (choices[c] == choice && named.insert(names[c]).second) first.push_back({{"caster", c}, {"part", names[c]}});
  return first;
}

/// Which casters were treated how, and why: counts, and the first few of each kind.
Json choicesJson(const std::vector<shadow::CasterChoice>& choices, const std::vector<std::string_view>& names) {
  Json list = Json::array();
  for (std::size_t kind = 0; kind < shadow::kCasterChoices; ++kind) {
    const auto choice = static_cast<shadow::CasterChoice>(kind);
    const auto count = static_cast<std::size_t>(std::count(choices.begin(), choices.end(), choice));
    if (count == 0) continue;
    list.push_back({{"choice", shadow::name(choice)},
                    {"reason", shadow::reason(choice)},
                    {"count", count},
                    {"first", firstOf(choice, choices, names)}});
  }
  return list;
}

Json softJson(const std::optional<shadow::SoftStats>& soft) {
  if (!soft) return nullptr;
  return {{"samples", soft->samples},
          {"estimated_error", soft->error},
          {"umbra_pixels", soft->umbra},
          {"penumbra_pixels", soft->penumbra}};
}

Json lightJson(const scene::Light& light, const shadow::LightStats& stats, const shadow::LightMask& mask,
               const std::vector<std::string_view>& parts) {
  return {{"light", light.name},
          {"technique", stats.method},
          {"reason", stats.reason},
          {"casters", choicesJson(stats.choices, parts)},
          {"casters_by_zfail", stats.castersByZFail},
          {"eye_count", stats.eyeCount},
          {"silhouette_finder", stats.finder.empty() ? Json(nullptr) : Json(stats.finder)},
          {"edges_tested", stats.edgesTested},
          {"silhouette_edges", stats.silhouetteEdges},
          {"volume_triangles", stats.volumeTriangles},
          {"volume_fragments", stats.volumeFragments ? Json(*stats.volumeFragments) : Json(nullptr)},
          {"left_out",
           {{"casters_in_shadow", stats.castersHidden},
            {"casters_behind", stats.castersBehind},
            {"sides_behind", stats.sidesBehind}}},
          {"endless_casters", stats.endlessCasters},
          {"planes", stats.planes},
          {"shadow_maps", stats.shadowMaps},
          {"shadow_map_texels", stats.mapTexels},
          {"soft", softJson(stats.soft)},
          {"lit_pixels", count(mask.light, 255)}};
}

Json phasesJson(const std::vector<shadow::PhaseTime>& phases) {
  Json json = Json::object();
  for (const auto& phase : phases) json[phase.name] = json.value(phase.name, 0.0) + phase.milliseconds;
  return json;
}

/// What less than this is left of counts as this: shadow::Filters.
constexpr double kDarkest = 0x1p-14;

/// Of the scene's materials that surfaces have, those in a channel of which less comes through than techniques can tell from nothing.
std::string darkChannels(const Stats& stats) {
  const auto& materials = stats.view.scene.materials;
  std::set<std::uint32_t> used(stats.geometry.surfaces.materials.begin(), stats.geometry.surfaces.materials.end());
  std::size_t rounded = 0;
  for (const std::uint32_t m : used) {
    const Vec3 part = scene::transmittance(materials[m]);
    const double most = std::max({part.x, part.y, part.z}), least = std::min({part.x, part.y, part.z});
    rounded += (most > 0.0 && least < kDarkest) ? 1 : 0;
  }
  if (rounded == 0) return {};
  return fmt::format(
      "{} material{} let{} less than 2^-14 of a channel through: that counts as 2^-14, and as nothing where no channel "
      "has more",
      rounded, rounded == 1 ? "" : "s", rounded == 1 ? "s" : "");
}

std::string limitedVeils(const Stats& stats) {
  const auto& veils = stats.drawing.shading.veils;
  const std::size_t lit = shadow::litVeilLayers(stats.view.veilLayers, veils, stats.geometry.filters);
  std::size_t beyond = 0, deepest = 0;
  for (std::size_t pixel = 0; pixel + 1 < veils.first.size(); ++pixel) {
    const std::size_t here = veils.at(pixel).size();
    beyond += here - std::min(here, lit), deepest = std::max(deepest, here);
  }
  if (beyond == 0) return {};
  const bool matter = stats.view.veilLayers == shadow::kVeilLayersThatMatter;
  return fmt::format("{} of {} transparent surfaces seen, behind the nearest {} of up to {} of a pixel, have {}{}",
                     beyond, veils.veils.size(), lit, deepest,
                     lit == 0 ? "no shadows" : "the light of the last of these",
                     matter ? ": less than 1/255 of them is seen" : "");
}

/// What is not exact in this picture, in words; empty: everything is.
std::vector<std::string> approximations(const Stats& stats) {
  std::vector<std::string> notes;
  for (const std::string& warning : stats.view.scene.warnings)
    if (warning.starts_with(io::kAlphaNote)) notes.push_back(warning);
  if (stats.drawing.traits.tinted && !stats.geometry.filters.empty())
    for (const std::string& note : {darkChannels(stats), limitedVeils(stats)})
      if (!note.empty()) notes.push_back(note);
  if (!stats.drawing.traits.tinted && !stats.geometry.filters.empty())
    notes.push_back("surfaces that let light through count as opaque");
  const auto& lights = stats.drawing.shading.stats.lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].soft)
      notes.push_back(fmt::format("light {} is {} points of it: an estimated error of {:.4f}", i,
                                  lights[i].soft->samples, lights[i].soft->error));
  return notes;
}

double total(const std::vector<shadow::PhaseTime>& phases) {
  double sum = 0.0;
  for (const auto& phase : phases) sum += phase.milliseconds;
  return sum;
}

}  // namespace

std::string statsJson(const Stats& stats) {
  const auto& camera = stats.view.camera;
  const auto& shading = stats.drawing.shading;
  const auto& renderer = stats.drawing.renderer;
  Json json{{"umbrage", UMBRAGE_VERSION},
            {"scene", stats.view.scene.source},
            {"technique", stats.drawing.traits.name},
            {"reason", stats.drawing.reason},
            {"gl_renderer", renderer.empty() ? Json(nullptr) : Json(renderer)},
            {"size", {camera.width, camera.height}},
            {"covered_pixels", coveredPixels(shading.surface)},
            {"unshadowed_pixels", count(shading.unshadowed, 1)},
            {"triangles", stats.geometry.surfaces.triangles.size()},
            {"degenerate_triangles", stats.geometry.surfaces.dropped},
            {"casters", castersJson(stats.geometry.casters)}};
  json["camera"] = {{"reason", stats.view.cameraReason},
                    {"eye", toJson(camera.eye)},
                    {"target", toJson(camera.target)},
                    {"fov_degrees", camera.fovY.degrees()}};
  json["light_reason"] = stats.view.lightReason;
  json["lights"] = Json::array();
  const auto parts = partNames(stats.view.scene, stats.geometry);
  for (std::size_t i = 0; i < shading.stats.lights.size(); ++i)
    json["lights"].push_back(lightJson(stats.view.lights[i], shading.stats.lights[i], shading.masks[i], parts));
  json["approximated"] = approximations(stats);
  json["phases_ms"] = phasesJson(stats.phases);
  json["shade_phases_ms"] = phasesJson(shading.stats.phases);
  json["total_ms"] = total(stats.phases);
  return jsonText(json);
}

std::string statsText(const Stats& stats) {
  std::string text = fmt::format("technique  {} ({})\n", stats.drawing.traits.name, stats.drawing.reason);
  text += fmt::format("camera     {}\n", stats.view.cameraReason);
  text += fmt::format("lights     {} ({})\n", stats.view.lights.size(), stats.view.lightReason);
  text += fmt::format("casters    {} triangles, {} edges\n", stats.geometry.casters.triangles.size(),
                      stats.geometry.casters.edges.size());
  for (const auto& light : stats.drawing.shading.stats.lights)
    if (!light.finder.empty())
      text += fmt::format("silhouette {} of {} tested edges ({})\n", light.silhouetteEdges, light.edgesTested,
                          light.finder);
  if (const auto& unknown = stats.drawing.shading.unshadowed; !unknown.empty())
    text += fmt::format("no shadows {} pixels show surfaces on which {} knows none\n", count(unknown, 1),
                        stats.drawing.traits.name);
  for (const auto& light : stats.drawing.shading.stats.lights)
    if (light.shadowMaps > 0) text += fmt::format("maps       {}\n", light.reason);
  for (const auto& light : stats.drawing.shading.stats.lights)
    if (light.volumeFragments)
      text += fmt::format("volumes    {} triangles, {} pixels filled\n", light.volumeTriangles, *light.volumeFragments);
  for (const std::string& note : approximations(stats)) text += fmt::format("approximated: {}\n", note);
  for (const auto& phase : stats.phases) text += fmt::format("{:<10} {:8.1f} ms\n", phase.name, phase.milliseconds);
  for (const auto& phase : stats.drawing.shading.stats.phases)
    text += fmt::format("  {:<18} {:8.1f} ms\n", phase.name, phase.milliseconds);
  return text + fmt::format("{:<10} {:8.1f} ms", "total", total(stats.phases));
}

}  // namespace umbrage::cli
