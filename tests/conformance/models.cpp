#include "conformance/models.hpp"

#include <algorithm>
#include <cctype>

#include "umbrage/io/load.hpp"

namespace umbrage::conformance {
namespace {

constexpr int kWidth = 320, kHeight = 240;

bool readable(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const auto known = io::readableExtensions();
  return std::find(known.begin(), known.end(), extension) != known.end();
}

}  // namespace

std::vector<std::filesystem::path> modelFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && readable(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Result<Case> modelCase(const std::filesystem::path& path) {
  auto loaded = io::loadScene(path);
  if (!loaded) return tl::unexpected(loaded.error());
  if (scene::triangleCount(*loaded) == 0) return fail(ErrorCode::input, "no triangles", path.string());
  const Box3 box = scene::bounds(*loaded);
  const scene::UpAxis axis = loaded->up;
  const Vec3 up = scene::upVector(axis), east = scene::eastVector(axis), north = scene::northVector(axis);
  const auto at = [&](double x, double y, double z) {
    return box.centre() + box.radius() * (x * east + y * north + z * up);
  };
  Case c{path.filename().string(), scene::withGround(std::move(*loaded)), {}, {}};
  c.lights = {{"sun", {scene::DirectionalLight{at(0, 0, 0) - at(-0.5, -0.7, 0.6)}, Vec3(1.0), 1.0, ""}},
              {"lamp", {scene::PointLight{at(0.8, -0.9, 1.3)}, Vec3(1.0), 1.0, ""}}};
  c.views = {{"framed", scene::frameAll(box, axis, Angle(), Angle::degrees(45), kWidth, kHeight)},
             {"close", looking(at(0.9, -0.8, 0.35), at(0.1, 0.1, -0.1), 60, kWidth, kHeight)}};
  for (NamedView& view : c.views) view.camera.up = up;
  return c;
}

}  // namespace umbrage::conformance
