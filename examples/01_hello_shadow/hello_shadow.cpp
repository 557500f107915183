// The shortest way from triangles to a picture with exact shadows: a hamlet in the afternoon sun.
//   hello_shadow [OUT.png]
#include <umbrage/png/png.hpp>
#include <umbrage/shadow/composite.hpp>
#include <umbrage/techniques/cpu/registry.hpp>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

using namespace umbrage;

// A scene is meshes, placed as instances, in the caller's own coordinates; here Z is up.
scene::Scene hamlet() {
  mesh::Mesh house{.name = "house"};
  house.positions = {{-2, -3, 0}, {2, -3, 0}, {2, 3, 0},  {-2, 3, 0}, {-2, -3, 3},
                     {2, -3, 3},  {2, 3, 3},  {-2, 3, 3}, {0, -3, 5}, {0, 3, 5}};
  house.triangles = {
      {0, 1, 5}, {0, 5, 4}, {4, 5, 8}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {6, 7, 9},   // walls
      {3, 0, 4}, {3, 4, 7}, {0, 2, 1}, {0, 3, 2}, {5, 6, 9}, {5, 9, 8}, {7, 4, 8}, {7, 8, 9}};  // and roof
  house.materials = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1};

  scene::Scene scene{.up = scene::UpAxis::z};
  scene.meshes = {std::make_shared<const mesh::Mesh>(house)};
  scene.materials = {{.name = "plaster", .colour = {0.8, 0.72, 0.58}}, {.name = "tiles", .colour = {0.55, 0.16, 0.09}}};
  for (int i = 0; i < 7; ++i) {
    const Mat4 turned = glm::rotate(Mat4(1.0), 0.85 * i, Vec3(0, 0, 1));
    scene.instances.push_back({.name = "house", .toWorld = glm::translate(turned, Vec3(11, 0, 0))});
  }
  return scene::withGround(scene);
}

Result<void> draw(const char* path) {
  const scene::Scene scene = hamlet();
  const scene::Camera camera{.eye = {-24, -11, 14}, .target = {0, -0.5, 1}, .width = 960, .height = 540};
  const std::vector<scene::Light> lights{{.shape = scene::DirectionalLight{{-0.3, 1, -0.75}}}};

  // Every technique of every registry is used in this way; all make the same mask.
  auto technique = techniques::cpuTechniques().front().create();
  if (!technique) return tl::unexpected(technique.error());
  const auto geometry = shadow::makeGeometry(scene);
  if (const auto ready = (*technique)->prepare(geometry); !ready) return ready;
  const auto shading = (*technique)->shade({camera, lights});
  if (!shading) return tl::unexpected(shading.error());

  return png::write(path,
                    shadow::composite(scene, geometry->surfaces, camera, shading->surface, lights, shading->masks));
}

int main(int count, char** words) {
  const char* path = count > 1 ? words[1] : "hello_shadow.png";
  if (const auto done = draw(path); !done) {
    std::fprintf(stderr, "error: %s\n", done.error().text().c_str());
    return exitCode(done.error().code);
  }
  std::puts(path);
}
