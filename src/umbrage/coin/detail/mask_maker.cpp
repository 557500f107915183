#include "umbrage/coin/detail/mask_maker.hpp"

#include <algorithm>
#include <thread>

#include "umbrage/gl/context.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#include "umbrage/techniques/gl/registry.hpp"

namespace umbrage::coin::detail {
namespace {

template <class Fn>
void elsewhere(bool needed, Fn&& work) {
  if (needed)
    std::thread(work).join();
  else
    work();
}

std::string nameOf(Method method) {
  switch (method) {
    case Method::zPass: return "zpass";
    case Method::zFail: return "zfail";
    case Method::rayTraced: return "ray_traced";
    case Method::automatic: break;
  }
  // As the command line chooses: on a processor our own rasteriser is faster than OpenGL.
  bool card = false;
  elsewhere(true, [&] {
    const auto context = gl::Context::createHeadless();
    card = context && !(*context)->isSoftware();
  });
  return card ? "zpass" : "hybrid_cpu";
}

std::vector<shadow::TechniqueEntry> allTechniques() {
  auto all = techniques::cpuTechniques();
  auto graphics = techniques::openGlTechniques();
  std::ranges::move(graphics, std::back_inserter(all));
  return all;
}

bool runsOnOpenGl(const std::unique_ptr<shadow::Technique>& technique) {
  return technique != nullptr && technique->traits().needsGraphics;
}

}  // namespace

MaskMaker::MaskMaker() = default;
MaskMaker::~MaskMaker() { drop(); }

void MaskMaker::drop() {
  elsewhere(runsOnOpenGl(technique_), [&] { technique_.reset(); });
  prepared_.reset();
  sighting_.reset();
  chosen_.reset();
}

Result<void> MaskMaker::choose(Method method) {
  if (chosen_ == method) return {};
  drop();
  const std::string name = nameOf(method);
  for (const shadow::TechniqueEntry& entry : allTechniques()) {
    if (entry.traits.name != name) continue;
    Result<void> done;
    elsewhere(entry.traits.needsGraphics, [&] {
      auto made = entry.create();
      if (made)
        technique_ = std::move(*made);
      else
        done = tl::unexpected(made.error());
    });
    if (!done) return done;
  }
  chosen_ = method;
  return {};
}

Result<void> MaskMaker::prepareTechnique(const World& world) {
  if (prepared_ == world.geometry) return {};
  Result<void> ready;
  elsewhere(runsOnOpenGl(technique_), [&] { ready = technique_->prepare(world.geometry); });
  prepared_ = ready ? world.geometry : nullptr;
  return ready;
}

Result<void> MaskMaker::prepareRays(const World& world) {
  if (traced_ == world.geometry) return {};
  auto built = trace::Occlusion::build({world.geometry, &world.geometry->surfaces});
  if (!built) return tl::unexpected(built.error());
  occlusion_.emplace(std::move(*built));
  traced_ = world.geometry;
  return {};
}

Result<shadow::Shading> MaskMaker::shade(const View& view, std::span<const scene::Light> lights, bool surfaceWanted) {
  Result<shadow::Shading> shading;
  elsewhere(runsOnOpenGl(technique_), [&] {
    shading = technique_->shade({.camera = *view.pinhole, .lights = lights, .surfaceWanted = surfaceWanted});
  });
  used_ = technique_->traits().name;
  if (shading && !shading->stats.surfaceKept) ++views_;
  return shading;
}

Result<std::vector<shadow::LightMask>> MaskMaker::byRays(const View& view, std::span<const scene::Light> lights) {
  std::vector<shadow::LightMask> masks;
  for (const scene::Light& light : lights) {
    auto mask = rayMask(*occlusion_, view, *sighting_->points, light);
    if (!mask) return tl::unexpected(mask.error());
    masks.push_back(std::move(*mask));
  }
  used_ = "ray_traced";
  return masks;
}

namespace {

// Where a technique has seen a triangle that is not drawn; empty: nowhere.
image::GreyImage missed(const image::Image<std::uint32_t>& seen, const Unseen& unseen) {
  image::GreyImage where;
  std::uint32_t last = shadow::kNoTriangle;  // neighbours mostly see the same
  bool isMissed = false;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::uint32_t triangle = seen.pixels()[i];
    if (triangle != last) isMissed = triangle != shadow::kNoTriangle && unseen(triangle);
    last = triangle;
    if (!isMissed) continue;
    if (where.empty()) where = image::GreyImage(seen.width(), seen.height());
    where.pixels()[i] = 1;
  }
  return where;
}

template <class T>
void copyWhere(const image::GreyImage& where, const image::Image<T>& from, image::Image<T>& to) {
  for (std::size_t i = 0; i < where.size(); ++i)
    if (where.pixels()[i] != 0) to.pixels()[i] = from.pixels()[i];
}

}  // namespace

// Backs of closed solids hide behind their fronts, so mostly nothing is to be done.
Result<void> MaskMaker::seeThrough(const World& world, const View& view, image::Image<std::uint32_t> triangle) {
  const Unseen unseen(world, view);
  Sighting sighting{world.geometry, view, std::move(triangle), {}, {}};
  if (!world.culled.empty()) sighting.missed = missed(sighting.triangle, unseen);
  if (!sighting.missed.empty()) {
    if (auto done = prepareRays(world); !done) return done;
    auto points = detail::look(*occlusion_, view, unseen, &sighting.missed);
    if (!points) return tl::unexpected(points.error());
    copyWhere(sighting.missed, points->triangle, sighting.triangle);
    sighting.points = std::move(*points);
  }
  sighting_ = std::move(sighting);
  return {};
}

Result<void> MaskMaker::look(const World& world, const View& view) {
  if (sighting_ && sighting_->geometry == world.geometry && sighting_->view == view) return {};
  sighting_.reset();
  if (!needsRays(world, view)) {
    auto shading = shade(view, {}, true);
    if (!shading) return tl::unexpected(shading.error());
    return seeThrough(world, view, std::move(shading->surface.triangle));
  }
  auto points = detail::look(*occlusion_, view, Unseen(world, view));
  ++views_;
  if (!points) return tl::unexpected(points.error());
  sighting_ = {world.geometry, view, points->triangle, {}, std::move(*points)};
  return {};
}

Result<void> MaskMaker::repair(const View& view, std::span<const scene::Light> lights,
                               std::vector<shadow::LightMask>& masks) const {
  if (sighting_->missed.empty()) return {};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    auto mask = rayMask(*occlusion_, view, *sighting_->points, lights[i]);
    if (!mask) return tl::unexpected(mask.error());
    copyWhere(sighting_->missed, mask->light, masks[i].light);
    copyWhere(sighting_->missed, mask->covered, masks[i].covered);
  }
  return {};
}

// Techniques take pinholes, and see whatever casts.
bool MaskMaker::needsRays(const World& world, const View& view) { return !view.pinhole || !world.veiled.empty(); }

Result<void> MaskMaker::prepare(const World& world, const View& view, Method method) {
  if (needsRays(world, view)) return prepareRays(world);
  if (auto done = choose(method); !done) return done;
  return prepareTechnique(world);
}

Result<const image::Image<std::uint32_t>*> MaskMaker::seen(const World& world, const View& view) {
  if (auto done = look(world, view); !done) return tl::unexpected(done.error());
  return &sighting_->triangle;
}

Result<std::vector<shadow::LightMask>> MaskMaker::masks(const World& world, const View& view,
                                                        std::span<const scene::Light> lights) {
  const bool byEye = needsRays(world, view) || !world.culled.empty();
  if (byEye)
    if (auto done = look(world, view); !done) return tl::unexpected(done.error());
  if (needsRays(world, view)) return byRays(view, lights);
  auto shading = shade(view, lights, false);
  if (!shading) return tl::unexpected(shading.error());
  if (byEye)
    if (auto done = repair(view, lights, shading->masks); !done) return tl::unexpected(done.error());
  return std::move(shading->masks);
}

}  // namespace umbrage::coin::detail
