#include <fmt/format.h>

#include "commands.hpp"
#include "outputs.hpp"
#include "umbrage/io/write.hpp"
#include "umbrage/samples/samples.hpp"

namespace umbrage::cli {
namespace {

struct SampleOptions {
  std::string name;
  std::string output;
  bool list = false;
};

std::string listText() {
  std::string text;
  for (const auto& sample : samples::list()) text += fmt::format("{:<12} {}\n", sample.name, sample.summary);
  return text;
}

// In the frame of the file: those that are read with --light are in the scene's own.
std::string lightText(const scene::Light& light, scene::UpAxis from, scene::UpAxis to) {
  const auto* point = std::get_if<scene::PointLight>(&light.shape);
  if (point == nullptr) return fmt::format("'{}'", light.name);
  const Vec3 p = from == to ? point->position : Vec3(point->position.x, point->position.z, -point->position.y);
  return fmt::format("'{}' (--light point:{:g},{:g},{:g},#ffffff,{:g})", light.name, p.x, p.y, p.z, light.intensity);
}

void warnOfLights(const scene::Scene& scene, const std::string& name, const std::string& path, const Console& console) {
  const auto up = hasExtension(path, ".json") ? scene::UpAxis::z : scene::UpAxis::y;
  for (const scene::Light& light : scene.lights)
    console.warn(fmt::format("{}: its light {} is not in the file; sample:{} has it", path,
                             lightText(light, scene.up, up), name));
}

Result<Outcome> run(const SampleOptions& options, const Console& console) {
  if (options.list) return Outcome{listText(), 0};
  if (options.name.empty()) return fail(ErrorCode::usage, "which sample? See: umbrage sample --list");
  if (options.output.empty()) return fail(ErrorCode::usage, "-o FILE is missing: .glb, .iv, .city.json or .obj");
  const auto scene = samples::make(options.name);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto open = checkOutputs({options.output}); !open) return tl::unexpected(open.error());
  const auto written =
      writeOutputs({{options.output, [&](const std::string& path) { return io::writeScene(*scene, path); }}});
  if (!written) return tl::unexpected(written.error());
  warnOfLights(*scene, options.name, options.output, console);
  return Outcome{fmt::format("{}  {} triangles\n", options.output, scene::triangleCount(*scene)), 0};
}

}  // namespace

Run addSample(CLI::App& app) {
  const auto options = std::make_shared<SampleOptions>();
  addWord(app, "NAME", "", "Which sample", options->name);
  addWord(app, "-o,--output", "FILE", "Where to write it: .glb, .iv, .city.json or .obj", options->output);
  addFlag(app, "--list", "The names of the samples", options->list);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
