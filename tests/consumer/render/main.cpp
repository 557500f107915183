// A host that links the renderer alone: triangles of its own on the graphics card, with OpenGL and nothing else.
#include <umbrage/gl/context.hpp>
#include <umbrage/render/gpu_scene.hpp>
#include <umbrage/render/pass_list.hpp>
#include <umbrage/shadow/technique.hpp>

#include <cstdio>

int main() {
  using namespace umbrage;
  mesh::Mesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene::Scene scene;
  scene.meshes = {std::make_shared<const mesh::Mesh>(square)};
  scene.materials = {{}};
  scene.instances = {{.name = "square"}};
  const auto geometry = shadow::makeGeometry(scene);
  if (render::planLights({}, true, {}, render::Product::picture).steps.empty()) return 1;

  const auto context = gl::Context::createHeadless();
  if (!context) {
    std::printf("no OpenGL on this machine: %s\n", context.error().text().c_str());
    return context.error().code == ErrorCode::device ? 0 : 1;
  }
  const gl::CurrentContext current(*context);
  const auto onCard = render::GpuScene::make(geometry->surfaces);
  return onCard && onCard->positions().bytes() > 0 ? 0 : 1;
}
