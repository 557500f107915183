#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "json.hpp"
#include "umbrage/mesh/edge_table.hpp"
#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::cli {
namespace {

constexpr std::size_t kListed = 12;

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
};

/// One placed mesh of the scene.
struct Part {
  std::string name;
  bool casts = true;
  mesh::MeshReport report;
};

/// What is told about a scene.
struct Info {
  std::size_t triangles = 0;
  std::size_t degenerate = 0;
  mesh::MeshReport whole;
  std::vector<Part> parts;
};

mesh::MeshReport inspectTriangles(std::span<const mesh::Triangle> triangles) {
  return mesh::inspect(triangles, mesh::buildEdgeTable(triangles));
}

Info gather(const scene::Scene& scene) {
  const scene::Surfaces surfaces = scene::flatten(scene);
  Info info;
  info.triangles = scene::triangleCount(scene);
  info.degenerate = surfaces.dropped;
  info.whole = inspectTriangles(surfaces.triangles);
  std::vector<std::vector<mesh::Triangle>> ofInstance(scene.instances.size());
  for (std::size_t i = 0; i < surfaces.triangles.size(); ++i)
    ofInstance[surfaces.instances[i]].push_back(surfaces.triangles[i]);
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    info.parts.push_back({scene.instances[i].name, scene.instances[i].casts, inspectTriangles(ofInstance[i])});
  return info;
}

const char* shapeName(const scene::Light& light) {
  if (scene::isArea(light)) return "area";  // no file has them yet
  if (std::holds_alternative<scene::PointLight>(light.shape)) return "point";
  return std::holds_alternative<scene::DirectionalLight>(light.shape) ? "directional" : "spot";
}

std::string hexColour(const Vec3& linear) {
  return fmt::format("#{:02x}{:02x}{:02x}", shadow::encodeSrgb(linear.r), shadow::encodeSrgb(linear.g),
                     shadow::encodeSrgb(linear.b));
}

// ---- as JSON ----

Json topologyJson(const mesh::MeshReport& r) {
  return {{"triangles", r.triangles},          {"edges", r.edges},
          {"border_edges", r.borderEdges},     {"non_manifold_edges", r.nonManifoldEdges},
          {"winding_flips", r.windingFlips},   {"components", r.components},
          {"topology", mesh::name(r.topology)}};
}

Json lightJson(const scene::Light& light) {
  Json json{{"name", light.name}, {"shape", shapeName(light)}};
  if (const auto* point = std::get_if<scene::PointLight>(&light.shape)) json["position"] = toJson(point->position);
  if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) json["direction"] = toJson(sun->direction);
  if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
    json["position"] = toJson(spot->position);
    json["direction"] = toJson(spot->direction);
    json["cutoff_degrees"] = spot->cutoff.degrees();
  }
  json["colour"] = toJson(light.colour);
  json["intensity"] = light.intensity;
  return json;
}

Json infoJson(const scene::Scene& scene, const Info& info) {
  const Box3 box = scene::bounds(scene);
  Json json{{"scene", scene.source},
            {"up", scene.up == scene::UpAxis::y ? "y" : "z"},
            {"metres_per_unit", scene.metresPerUnit},
            {"north_degrees", scene.northOffset.degrees()},
            {"crs", scene.crs},
            {"triangles", info.triangles},
            {"degenerate_triangles", info.degenerate},
            {"edges", info.whole.edges},
            {"border_edges", info.whole.borderEdges},
            {"non_manifold_edges", info.whole.nonManifoldEdges},
            {"winding_flips", info.whole.windingFlips},
            {"components", info.whole.components},
            {"topology", mesh::name(info.whole.topology)}};
  json["bounds"] = box.empty() ? Json(nullptr) : Json{{"min", toJson(box.min)}, {"max", toJson(box.max)}};
  json["parts"] = Json::array();
  for (const Part& part : info.parts) {
    Json entry{{"name", part.name}, {"casts", part.casts}};
    entry.update(topologyJson(part.report));
    json["parts"].push_back(entry);
  }
  json["materials"] = Json::array();
  for (const auto& material : scene.materials)
    json["materials"].push_back({{"name", material.name},
                                 {"colour", toJson(material.colour)},
                                 {"srgb", hexColour(material.colour)},
                                 {"opacity", material.opacity}});
  json["lights"] = Json::array();
  for (const auto& light : scene.lights) json["lights"].push_back(lightJson(light));
  json["warnings"] = scene.warnings;
  return json;
}

// ---- for people ----

std::string rest(std::size_t count) {
  return count > kListed ? fmt::format("             and {} more (see --json)\n", count - kListed) : "";
}

std::string line(std::string_view label, const std::string& text) { return fmt::format("{:<12} {}\n", label, text); }

std::string point(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

std::string boundsText(const scene::Scene& scene) {
  const Box3 box = scene::bounds(scene);
  if (box.empty()) return line("bounds", "none");
  const Vec3 metres = box.size() * scene.metresPerUnit;
  return line("bounds", fmt::format("{} to {}", point(box.min), point(box.max))) +
         line("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m", metres.x, metres.y, metres.z));
}

std::string partsText(const Info& info) {
  std::string text = line("parts", std::to_string(info.parts.size()));
  for (std::size_t i = 0; i < std::min(kListed, info.parts.size()); ++i) {
    const Part& part = info.parts[i];
    text += fmt::format("  {:>10} triangles  {:<12} {}{}\n", part.report.triangles, mesh::name(part.report.topology),
                        shortName(part.name), part.casts ? "" : " (casts nothing)");
  }
  return text + rest(info.parts.size());
}

std::string materialsText(const scene::Scene& scene) {
  std::string text = line("materials", std::to_string(scene.materials.size()));
  for (std::size_t i = 0; i < std::min(kListed, scene.materials.size()); ++i) {
    const auto& material = scene.materials[i];
    text += fmt::format("  {}  {:>4.0f} % opaque  {}\n", hexColour(material.colour), 100.0 * material.opacity,
                        shortName(material.name));
  }
  return text + rest(scene.materials.size());
}

std::string lightsText(const scene::Scene& scene) {
  std::string text = line("lights", std::to_string(scene.lights.size()));
  for (std::size_t i = 0; i < std::min(kListed, scene.lights.size()); ++i)
    text += fmt::format("  {:<11}  {}  x {:.3g}  {}\n", shapeName(scene.lights[i]), hexColour(scene.lights[i].colour),
                        scene.lights[i].intensity, shortName(scene.lights[i].name));
  return text + rest(scene.lights.size());
}

std::string warningsText(const scene::Scene& scene) {
  std::string text = line("warnings", std::to_string(scene.warnings.size()));
  for (const auto& warning : scene.warnings) text += fmt::format("  {}\n", warning);
  return text;
}

std::string infoText(const scene::Scene& scene, const Info& info) {
  const auto& whole = info.whole;
  std::string text = line("scene", scene.source);
  text += line("frame", fmt::format("{} up, 1 unit = {:g} m{}", scene.up == scene::UpAxis::y ? "Y" : "Z",
                                    scene.metresPerUnit, scene.crs.empty() ? "" : ", " + scene.crs));
  text += line("triangles", info.degenerate == 0
                                ? fmt::format("{}", info.triangles)
                                : fmt::format("{}, {} of them without area", info.triangles, info.degenerate));
  text += line("edges",
               fmt::format("{}: {} border, {} non-manifold", whole.edges, whole.borderEdges, whole.nonManifoldEdges));
  text += line("topology", fmt::format("{}, {} connected {}", mesh::name(whole.topology), whole.components,
                                       whole.components == 1 ? "piece" : "pieces"));
  return printable(text + boundsText(scene) + partsText(info) + materialsText(scene) + lightsText(scene) +
                   warningsText(scene));
}

Result<Outcome> run(const InfoOptions& options) {
  const auto scene = loadScene(options.scene);
  if (!scene) return tl::unexpected(scene.error());
  const Info info = gather(*scene);
  return Outcome{options.json ? jsonText(infoJson(*scene, info)) : infoText(*scene, info), 0};
}

}  // namespace

Run addInfo(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  addSceneOptions(app, options->scene);
  addFlag(app, "--json", "As JSON", options->json);
  return [options](const Console&) { return run(*options); };
}

}  // namespace umbrage::cli
