#include "umbrage/coin/detail/mask_maker.hpp"

#include <algorithm>
#include <thread>

#include "umbrage/coin/detail/ray_masks.hpp"
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

Result<Reach> MaskMaker::byTechnique(const View& view, std::span<const scene::Light> lights) {
  Result<shadow::Shading> shading;
  elsewhere(runsOnOpenGl(technique_), [&] { shading = technique_->shade({*view.pinhole, lights}); });
  if (!shading) return tl::unexpected(shading.error());
  used_ = technique_->traits().name;
  return Reach{std::move(shading->surface.triangle), std::move(shading->masks)};
}

Result<Reach> MaskMaker::byRays(const World& world, const View& view, std::span<const scene::Light> lights) {
  auto seen = look(*occlusion_, view, Unseen(world, view));
  if (!seen) return tl::unexpected(seen.error());
  Reach reach;
  for (const scene::Light& light : lights) {
    auto mask = rayMask(*occlusion_, view, *seen, light);
    if (!mask) return tl::unexpected(mask.error());
    reach.masks.push_back(std::move(*mask));
  }
  used_ = "ray_traced";
  reach.triangle = std::move(seen->triangle);
  return reach;
}

namespace {

// Where a technique has seen a triangle that is not drawn; empty: nowhere.
image::GreyImage missed(const Reach& reach, const Unseen& unseen) {
  image::GreyImage where;
  std::uint32_t last = shadow::kNoTriangle;  // neighbours mostly see the same
  bool isMissed = false;
  for (std::size_t i = 0; i < reach.triangle.size(); ++i) {
    const std::uint32_t triangle = reach.triangle.pixels()[i];
    if (triangle != last) isMissed = triangle != shadow::kNoTriangle && unseen(triangle);
    last = triangle;
    if (!isMissed) continue;
    if (where.empty()) where = image::GreyImage(reach.triangle.width(), reach.triangle.height());
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
Result<void> MaskMaker::seeThrough(const World& world, const View& view, std::span<const scene::Light> lights,
                                   Reach& reach) {
  if (world.culled.empty()) return {};
  const Unseen unseen(world, view);
  const image::GreyImage where = missed(reach, unseen);
  if (where.empty()) return {};
  if (auto done = prepareRays(world); !done) return done;
  auto seen = look(*occlusion_, view, unseen, &where);
  if (!seen) return tl::unexpected(seen.error());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    auto mask = rayMask(*occlusion_, view, *seen, lights[i]);
    if (!mask) return tl::unexpected(mask.error());
    copyWhere(where, mask->light, reach.masks[i].light);
    copyWhere(where, mask->covered, reach.masks[i].covered);
  }
  copyWhere(where, seen->triangle, reach.triangle);
  return {};
}

// Techniques take pinholes, and see whatever casts.
bool MaskMaker::needsRays(const World& world, const View& view) { return !view.pinhole || !world.veiled.empty(); }

Result<void> MaskMaker::prepare(const World& world, const View& view, Method method) {
  if (needsRays(world, view)) return prepareRays(world);
  if (auto done = choose(method); !done) return done;
  return prepareTechnique(world);
}

Result<Reach> MaskMaker::masks(const World& world, const View& view, std::span<const scene::Light> lights) {
  if (needsRays(world, view)) return byRays(world, view, lights);
  auto reach = byTechnique(view, lights);
  if (reach)
    if (auto done = seeThrough(world, view, lights, *reach); !done) return tl::unexpected(done.error());
  return reach;
}

}  // namespace umbrage::coin::detail
