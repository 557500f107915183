#include "umbrage/render/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <umbrage_shaders/overlay_frag.hpp>
#include <umbrage_shaders/overlay_vert.hpp>

#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/uniforms.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::render {
namespace {

// Sides end where they leave the scene, but not before and not beyond these many radii of the casters.
constexpr double kShortest = 2.0, kLongest = 8.0;
// Lines lie on the surfaces they belong to; this lifts them off by a share of their distance.
constexpr double kLift = 1e-3;

struct Mark {
  Vec4f clip, colour, line;
};

struct Palette {
  Vec3f volume, line;
};
constexpr std::array<Palette, 4> kPalettes{{{{0.25f, 0.33f, 0.92f}, {0.86f, 0.05f, 0.22f}},
                                            {{0.95f, 0.55f, 0.05f}, {0.10f, 0.30f, 0.75f}},
                                            {{0.05f, 0.62f, 0.45f}, {0.60f, 0.10f, 0.65f}},
                                            {{0.75f, 0.20f, 0.60f}, {0.05f, 0.45f, 0.30f}}}};

Vec4f tint(const Vec3f& colour, double alpha) { return Vec4f(colour, 1.0f) * static_cast<float>(alpha); }

class Marks {
 public:
  Marks(const View& view, const scene::Camera& camera, const shadow::Geometry& geometry)
      : view_(view),
        camera_(camera),
        casters_(geometry.casters),
        room_(geometry.surfaces.bounds),
        radius_(casters_.bounds.radius()) {}

  // A side fades with the distance from its edge. Faces of one colour laid over each other give the same in any order.
  void addSides(const shadow::Silhouette& silhouette, const Vec3f& colour) {
    const double alpha = std::max(0.015, 0.2 / std::sqrt(1.0 + double(silhouette.edges.size()) / 60.0));
    for (const shadow::SilhouetteEdge& edge : silhouette.edges) {
      const std::array<Vec3, 2> near{casters_.position(edge.a), casters_.position(edge.b)};
      std::array<Vec3, 2> far;
      std::array<Vec4f, 2> end;
      for (int i = 0; i < 2; ++i) {
        const double length = reach(near[i], silhouette.light);
        far[i] = near[i] + length * away(near[i], silhouette.light);
        end[i] = tint(colour, alpha * (1.0 - length / (kLongest * radius_)));
      }
      const auto add = [&](const Vec3& p, const Vec4f& c) { marks.push_back({Vec4f(clip(p)), c, Vec4f(0.0f)}); };
      const Vec4f full = tint(colour, alpha);
      add(near[0], full), add(near[1], full), add(far[0], end[0]);
      add(near[1], full), add(far[1], end[1]), add(far[0], end[0]);
    }
  }

  void addLines(const shadow::Silhouette& silhouette, const Vec3f& colour) {
    // The more edges, the finer, or dense parts would be one blot.
    const double crowd = std::pow(1.0 + double(silhouette.edges.size()) / 2000.0, -0.35);
    halfWidth_ = 0.6 + 1.2 * crowd;
    for (const shadow::SilhouetteEdge& edge : silhouette.edges) addLine(edge, tint(colour, 0.35 + 0.6 * crowd));
  }

  std::vector<Mark> marks;

 private:
  [[nodiscard]] static Vec3 away(const Vec3& p, const Vec4& light) {
    const Vec3 direction = p * light.w - Vec3(light);
    const double length = glm::length(direction);
    return length > 0.0 ? direction / length : Vec3(0.0);
  }

  [[nodiscard]] double reach(const Vec3& p, const Vec4& light) const {
    const Vec3 direction = away(p, light);
    double leave = kLongest * radius_;
    for (int k = 0; k < 3; ++k)
      if (direction[k] != 0.0)
        leave = std::min(leave, ((direction[k] > 0.0 ? room_.max[k] : room_.min[k]) - p[k]) / direction[k]);
    return std::max(leave, kShortest * radius_);
  }

  [[nodiscard]] Vec4 clip(const Vec3& p) const { return view_.toClip * Vec4(p + casters_.origin - view_.eye, 1.0); }

  void addLine(const shadow::SilhouetteEdge& edge, const Vec4f& colour) {
    Vec4 a = clip(casters_.position(edge.a)), b = clip(casters_.position(edge.b));
    const double nearest = 1e-3 * radius_;
    if (a.w < nearest && b.w < nearest) return;
    if (a.w < nearest) a = glm::mix(b, a, (b.w - nearest) / (b.w - a.w));
    if (b.w < nearest) b = glm::mix(a, b, (a.w - nearest) / (a.w - b.w));
    const Vec2 pixels = 0.5 * Vec2(camera_.width, camera_.height);
    Vec2 along = (Vec2(b) / b.w - Vec2(a) / a.w) * pixels;
    const double length = glm::length(along);
    along = length > 1e-9 ? along / length : Vec2(1, 0);
    const Vec2 sideways = Vec2(-along.y, along.x) * (halfWidth_ / pixels);
    const auto add = [&](const Vec4& end, double side) {
      const Vec2 xy = Vec2(end) + side * end.w * sideways;
      const Vec4 lifted(xy, end.z * (1.0 + kLift), end.w);
      marks.push_back({Vec4f(lifted), colour, Vec4f(float(side), float(halfWidth_), 0.0f, 0.0f)});
    };
    for (const auto& [end, side] : {std::pair(a, -1.0), {a, 1.0}, {b, -1.0}, {b, -1.0}, {a, 1.0}, {b, 1.0}})
      add(end, side);
  }

  const View& view_;
  const scene::Camera& camera_;
  const shadow::CasterSet& casters_;
  Box3 room_;
  double radius_;
  double halfWidth_ = 1.0;  // of lines, in pixels
};

std::vector<Mark> marksFor(const View& view, const shadow::Geometry& geometry, const scene::Camera& camera,
                           std::span<const scene::Light> lights, const OverlayOptions& options) {
  Marks marks(view, camera, geometry);
  std::vector<shadow::Silhouette> silhouettes;
  for (const scene::Light& light : lights)
    silhouettes.push_back(shadow::findSilhouette(geometry.casters, scene::homogeneous(light, geometry.casters.origin)));
  const auto palette = [](std::size_t i) { return kPalettes[i % kPalettes.size()]; };
  if (options.volumes)
    for (std::size_t i = 0; i < lights.size(); ++i) marks.addSides(silhouettes[i], palette(i).volume);
  if (options.silhouette)
    for (std::size_t i = 0; i < lights.size(); ++i) marks.addLines(silhouettes[i], palette(i).line);
  return std::move(marks.marks);
}

// The marks on a clear ground, premultiplied, where the surfaces do not hide them.
Result<image::RgbaImage> drawLayer(const std::vector<Mark>& marks, const View& view, const shadow::Geometry& geometry,
                                   const scene::Camera& camera) {
  gl::HostScope scope;
  auto frame = GpuFrame::make(camera.width, camera.height);
  if (!frame) return tl::unexpected(frame.error());
  if (auto done = frame->needPicture(); !done) return tl::unexpected(done.error());
  auto gpuScene = GpuScene::make(geometry.surfaces);
  if (!gpuScene) return tl::unexpected(gpuScene.error());
  const Vec3& origin = geometry.surfaces.origin;
  gl::Buffer viewData, shading, markData;
  for (const auto& done : {gpuScene->arrangeFor(geometry, view, camera.width, camera.height),
                           viewData.setOne(viewBlock(view, origin, Vec4(0.0))), shading.setOne(shadingBlock(camera))})
    if (!done) return tl::unexpected(done.error());
  if (auto done = setStorage(markData, std::as_bytes(std::span(marks)), "marks"); !done)
    return tl::unexpected(done.error());

  gl::PassState placement;
  placement.viewport = {0, 0, camera.width, camera.height};
  Programs programs;
  const std::vector<GpuLight> none;
  run(scope, planSurfaces(placement, view.reversed),
      {.programs = programs,
       .positions = gpuScene->positions(),
       .scene = &*gpuScene,
       .frame = &*frame,
       .view = &viewData,
       .shading = &shading,
       .lights = none});

  const gl::Program program(shaders::kOverlayVert, shaders::kOverlayFrag);
  gl::PassState state = placement;
  state.depth = {.test = true, .pass = gl::Compare::greater};
  state.colourWrite = true;
  state.blend = gl::Blend::over;
  {
    gl::Pass pass(scope, frame->sumTarget(), state);
    pass.clearColour({0.0f, 0.0f, 0.0f, 0.0f});
    pass.use(program);
    pass.storage(0, markData);
    pass.draw(gpuScene->drawn().vertices(), marks.size());
  }
  return gl::readRgba(scope, frame->sumTarget(), camera.width, camera.height);
}

image::RgbImage laidOver(const image::RgbImage& picture, const image::RgbaImage& layer) {
  image::RgbImage out = picture;
  const auto mix = [](std::uint8_t below, std::uint8_t above, std::uint8_t alpha) {
    return static_cast<std::uint8_t>(std::min(255, above + (below * (255 - alpha) + 127) / 255));
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    image::Rgb8& p = out.pixels()[i];
    const image::Rgba8& l = layer.pixels()[i];
    p = {mix(p.r, l.r, l.a), mix(p.g, l.g, l.a), mix(p.b, l.b, l.a)};
  }
  return out;
}

}  // namespace

Result<image::RgbImage> drawOverlay(const image::RgbImage& picture, const shadow::Geometry& geometry,
                                    const scene::Camera& camera, std::span<const scene::Light> lights,
                                    const OverlayOptions& options, std::shared_ptr<gl::Context> context) {
  UMBRAGE_CHECK(picture.width() == camera.width && picture.height() == camera.height, "picture size");
  if (context == nullptr) {
    auto made = gl::Context::createHeadless();
    if (!made) return tl::unexpected(made.error());
    context = std::move(*made);
  }
  const View view = viewOf(camera, geometry.surfaces.bounds.radius());
  const std::vector<Mark> marks = marksFor(view, geometry, camera, lights, options);
  const gl::CurrentContext current(context);
  const auto layer = drawLayer(marks, view, geometry, camera);
  if (!layer) return tl::unexpected(layer.error());
  return laidOver(picture, *layer);
}

}  // namespace umbrage::render
