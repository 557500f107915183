#include <fmt/format.h>

#include "commands.hpp"
#include "json.hpp"
#include "moments.hpp"
#include "outputs.hpp"
#include "umbrage/cut/lit_scene.hpp"
#include "umbrage/io/write.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::cli {
namespace {

struct CutOptions {
  SceneOptions scene;
  ViewOptions view;
  PlaceOptions place;
  MomentOptions moments;
  double ambient = 0.3;
  std::string output;
  bool json = false;
};

/// What the surfaces are cut by.
struct Lights {
  std::vector<scene::Light> lights;
  std::vector<std::string> names;
};

std::string nameOf(const scene::Light& light, std::size_t number) {
  return light.name.empty() ? fmt::format("light {}", number + 1) : light.name;
}

// The sun at each moment asked for, or lights as for pictures.
Result<Lights> lightsOf(const CutOptions& options, const View& view, const Console& console) {
  Lights out;
  if (options.moments.at.empty()) {
    if (options.place.date.ok() || options.place.latitude)
      return fail(ErrorCode::usage, "--date, --lat and --lon need a moment: --at HH:MM");
    out.lights = view.lights;
    for (std::size_t k = 0; k < out.lights.size(); ++k) out.names.push_back(nameOf(out.lights[k], k));
    return out;
  }
  if (!options.view.lights.empty()) return fail(ErrorCode::usage, "--at and --light exclude one another");
  if (!options.place.date.ok() || options.place.zone.name.empty())
    return fail(ErrorCode::usage, "--at needs a day and its clock: --date YYYY-MM-DD --tz ZONE");
  const auto place = placeOf(options.place, view.scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  const auto moments = momentsOf(options.moments, options.place, *place);
  if (!moments) return tl::unexpected(moments.error());
  for (const auto& warning : moments->warnings) console.warn(warning);
  for (const auto& step : moments->steps) {
    out.lights.push_back(study::sunLight(step.sun, view.scene.up, view.scene.northOffset));
    out.names.push_back(fmt::format("sun at {}, {:.2f} up, azimuth {:.2f}", step.label, step.sun.elevation.degrees(),
                                    step.sun.azimuth.degrees()));
  }
  return out;
}

/// Square metres.
struct Table {
  std::vector<cut::Areas> materials;
  cut::Areas all;
  double square = 1.0;
};

double share(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

std::string areasText(const scene::Scene& scene, const Lights& lights, const Table& table) {
  std::string text;
  for (std::size_t k = 0; k < lights.names.size(); ++k) {
    text += fmt::format("{}\n", shortName(lights.names[k]));
    const auto row = [&](const std::string& name, const cut::Areas& a) {
      text += fmt::format("  {:>14.2f} m2 lit  {:>14.2f} m2 in shadow  {:>5.1f} % lit  {}\n",
                          a.lights[k].lit * table.square, a.lights[k].shadowed * table.square,
                          share(a.lights[k].lit, a.surface), name);
    };
    for (std::size_t m = 0; m < table.materials.size(); ++m)
      if (table.materials[m].surface > 0.0) row(shortName(scene.materials[m].name), table.materials[m]);
    row("all together", table.all);
  }
  return printable(text);
}

Json areasJson(const cut::Areas& areas, double square) {
  Json json{{"surface_m2", areas.surface * square}, {"lights", Json::array()}};
  for (const auto& light : areas.lights)
    json["lights"].push_back({{"lit_m2", light.lit * square}, {"shadowed_m2", light.shadowed * square}});
  return json;
}

std::string allJson(const CutOptions& options, const scene::Scene& scene, const Lights& lights,
                    const cut::Pieces& pieces, const Table& table) {
  Json json{{"scene", scene.source}, {"output", options.output}, {"pieces", pieces.pieces.size()}};
  json["lights"] = lights.names;
  json["total"] = areasJson(table.all, table.square);
  json["materials"] = Json::array();
  for (std::size_t m = 0; m < table.materials.size(); ++m) {
    Json entry{{"name", scene.materials[m].name}};
    entry.update(areasJson(table.materials[m], table.square));
    json["materials"].push_back(entry);
  }
  json["conventions"] =
      "each triangle counts once, by its side that faces the light; shadowed also: the light lies in its plane";
  return jsonText(json);
}

Result<void> check(const CutOptions& options) {
  if (options.output.empty()) return {};
  if (const auto known = checkExtension("-o", options.output, {".glb", ".iv", ".obj"}); !known) return known;
  return checkOutputs({options.output}, options.scene.file);
}

Result<Outcome> run(const CutOptions& options, const Console& console) {
  if (const auto open = check(options); !open) return tl::unexpected(open.error());
  auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  const auto view = makeView(std::move(*scene), options.view);
  if (!view) return tl::unexpected(view.error());
  const auto lights = lightsOf(options, *view, console);
  if (!lights) return tl::unexpected(lights.error());
  if (lights->lights.size() > cut::kMostLights)
    return fail(ErrorCode::usage, fmt::format("--light: {} lights at most", cut::kMostLights));
  for (const auto& light : lights->lights)
    if (scene::isArea(light))
      console.warn("a light with an extent cuts as its centre does: shadows have sharp borders here");

  Stopwatch watch;
  const auto geometry = shadow::makeGeometry(view->scene);
  const auto pieces = cut::cutSurfaces(geometry, lights->lights, console.progress());
  if (!pieces) return tl::unexpected(pieces.error());
  console.detail(fmt::format("cut        {:.0f} ms, {} triangles into {} pieces", watch.lap(),
                             geometry->surfaces.triangles.size(), pieces->pieces.size()));
  Table table;
  table.materials =
      cut::areasByMaterial(geometry->surfaces, view->scene.materials.size(), *pieces, lights->lights.size());
  table.all = cut::sum(table.materials);
  table.all.lights.resize(lights->lights.size());
  table.square = view->scene.metresPerUnit * view->scene.metresPerUnit;
  if (!options.output.empty()) {
    const auto lit = cut::litScene(view->scene, geometry->surfaces, *pieces, lights->lights.size(), options.ambient);
    const auto written =
        writeOutputs({{options.output, [&](const std::string& path) { return io::writeScene(lit, path); }}});
    if (!written) return tl::unexpected(written.error());
    console.detail(fmt::format("written    {:.0f} ms", watch.lap()));
  }
  if (options.json) return Outcome{allJson(options, view->scene, *lights, *pieces, table), 0};
  return Outcome{(options.output.empty() ? "" : options.output + "\n") + areasText(view->scene, *lights, table), 0};
}

}  // namespace

Run addCut(CLI::App& app) {
  const auto options = std::make_shared<CutOptions>();
  addSceneOptions(app, options->scene);
  addWord(app, "-o,--output", "OUT", "The scene in lit and shadowed parts: .glb, .iv or .obj (default: areas alone)",
          options->output);
  addValues(app, "--light", "SPEC",
            "point:x,y,z, directional:dx,dy,dz (the way the light travels) or spot:x,y,z,dx,dy,dz,CUTOFF_DEG; "
            "repeatable (default: the file's lights, else a sun)",
            options->view.lights, parseLight);
  addPlaceOptions(app, options->place, PlaceFrom::nobody);
  addValues(app, "--at", "HH:MM[:SS]", "The sun at this moment; repeatable", options->moments.at, sun::parseTime,
            {.group = "Place and time"});
  addGroundOption(app, options->view);
  addValue(app, "--ambient", "A", "How bright shadowed parts are coloured, 0 to 1 (default 0.3)", options->ambient,
           [](std::string_view word) { return parseNumber(word, 0.0, 1.0); });
  addFlag(app, "--json", "The areas as JSON", options->json);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
