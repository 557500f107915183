// The shortest way from triangles to a picture with exact shadows: a box on the ground in the sun.
//   hello_shadow [OUT.png]
#include <umbrage/png/png.hpp>
#include <umbrage/shadow/composite.hpp>
#include <umbrage/shadow/technique.hpp>
#include <umbrage/techniques/cpu/registry.hpp>

#include <cstdio>
#include <memory>
#include <vector>

using namespace umbrage;

// A scene is meshes, placed as instances, in the caller's own coordinates; here Z is up.
scene::Scene boxOnTheGround() {
  mesh::Mesh box;
  for (int i = 0; i < 8; ++i) box.positions.push_back(Vec3(i & 1, i >> 1 & 1, i >> 2 & 1) * Vec3(4, 3, 2));
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  scene::Scene scene;
  scene.up = scene::UpAxis::z;
  scene.meshes = {std::make_shared<const mesh::Mesh>(box)};
  scene.materials = {{.name = "clay", .colour = {0.75, 0.45, 0.3}}};
  scene.instances = {{.name = "box"}};
  return scene::withGround(scene);
}

Result<void> draw(const char* path) {
  const scene::Scene scene = boxOnTheGround();
  const scene::Camera camera = {.eye = {-4.5, -6, 5}, .target = {0.6, 1.2, 0.5}, .width = 640, .height = 400};
  const std::vector<scene::Light> lights = {{.shape = scene::DirectionalLight{{-1, 0.35, -0.8}}}};

  // Any technique of any registry is used in the same way; all make the same mask.
  auto technique = techniques::cpuTechniques().front().create();
  if (!technique) return tl::unexpected(technique.error());
  const auto geometry = shadow::makeGeometry(scene);
  if (const auto ready = (*technique)->prepare(geometry); !ready) return ready;
  const auto shading = (*technique)->shade({camera, lights});
  if (!shading) return tl::unexpected(shading.error());

  const auto picture = shadow::composite(scene, geometry->surfaces, camera, shading->surface, lights, shading->masks);
  return png::write(path, picture);
}

int main(int count, char** words) {
  const char* path = count > 1 ? words[1] : "hello_shadow.png";
  if (const auto done = draw(path); !done) {
    std::fprintf(stderr, "error: %s\n", done.error().text().c_str());
    return exitCode(done.error().code);
  }
  std::printf("%s\n", path);
  return 0;
}
