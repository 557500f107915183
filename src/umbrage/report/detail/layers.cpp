#include "umbrage/report/detail/layers.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/report/colours.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::report::detail {
namespace {

constexpr double kPale = 0.55;          // how far colours go towards white
constexpr double kCreaseCosine = 0.90;  // normals farther apart than 26 degrees make a crease
constexpr float kDepthJump = 0.01f;     // relative, beyond what the slope explains

Vec3 pale(const Vec3& colour) { return colour * (1.0 - kPale) + Vec3(0.86) * kPale; }

// The scene's colours as the model shows them: pale, and parts in theirs.
struct Look {
  scene::Scene scene;
  scene::Surfaces surfaces;
};

Vec3 linear(image::Rgb8 c) { return {shadow::decodeSrgb(c.r), shadow::decodeSrgb(c.g), shadow::decodeSrgb(c.b)}; }

Look lookOf(const scene::Scene& scene, const study::Profile& profile) {
  Look look{scene, profile.geometry->surfaces};
  const bool parts = !profile.parts.empty();
  for (scene::Material& m : look.scene.materials)
    m.colour = parts ? Vec3(glm::dot(pale(m.colour), Vec3(0.21, 0.72, 0.07))) : pale(m.colour);
  std::vector<std::uint32_t> materialOf(scene.instances.size(), shadow::kNoTriangle);
  for (std::size_t p = 0; p < profile.parts.size(); ++p) {
    for (const std::uint32_t instance : profile.parts[p].instances)
      materialOf[instance] = static_cast<std::uint32_t>(look.scene.materials.size());
    look.scene.materials.push_back({profile.parts[p].pattern, 0.75 * linear(partColour(p, 0.8)) + Vec3(0.25), 1.0});
  }
  for (std::size_t t = 0; t < look.surfaces.triangles.size(); ++t)
    if (const auto m = materialOf[look.surfaces.instances[t]]; m != shadow::kNoTriangle) look.surfaces.materials[t] = m;
  return look;
}

// A sun that shows the form from any side: from over the viewer's left shoulder.
scene::Light modelLight(const scene::Camera& camera, scene::UpAxis up) {
  const scene::CameraBasis b = scene::basis(camera);
  scene::Light light;
  light.shape = scene::DirectionalLight{glm::normalize(b.forward + 0.75 * b.right - 1.3 * scene::upVector(up))};
  light.intensity = 0.55;
  return light;
}

Vec3 unitNormal(const scene::Surfaces& s, std::uint32_t t) { return glm::normalize(s.normal(t)); }

// Whether two neighbouring pixels do not lie on one smooth surface.
bool breaks(const study::Profile& p, int x, int y, int dx, int dy) {
  const std::uint32_t a = p.surface.triangle(x, y), b = p.surface.triangle(x + dx, y + dy);
  if (a == b) return false;
  if (a == shadow::kNoTriangle || b == shadow::kNoTriangle) return true;
  const auto& s = p.geometry->surfaces;
  if (std::abs(glm::dot(unitNormal(s, a), unitNormal(s, b))) < kCreaseCosine) return true;
  // The slope towards the far neighbours predicts the step in depth between the two.
  const auto depth = [&](int px, int py) { return p.surface.depth(px, py); };
  const float step = std::abs(depth(x + dx, y + dy) - depth(x, y));
  float slope = 0.0f;
  if (p.surface.depth.contains(x - dx, y - dy)) slope = std::max(slope, std::abs(depth(x, y) - depth(x - dx, y - dy)));
  if (p.surface.depth.contains(x + 2 * dx, y + 2 * dy))
    slope = std::max(slope, std::abs(depth(x + 2 * dx, y + 2 * dy) - depth(x + dx, y + dy)));
  return step > kDepthJump * depth(x, y) && step > 3.0f * slope;
}

std::uint8_t code(float v) { return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f))); }

}  // namespace

Vec3f toVec(image::Rgb8 c) { return Vec3f(c.r, c.g, c.b) / 255.0f; }

image::RgbImage toRgb(const Layer& layer) {
  image::RgbImage out(layer.width(), layer.height());
  for (std::size_t i = 0; i < layer.size(); ++i) {
    const Vec3f& c = layer.pixels()[i];
    out.pixels()[i] = {code(c.x), code(c.y), code(c.z)};
  }
  return out;
}

image::GreyImage formEdges(const study::Profile& profile) {
  const int width = profile.camera.width, height = profile.camera.height;
  image::GreyImage edges(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool right = x + 1 < width && breaks(profile, x, y, 1, 0);
      const bool below = y + 1 < height && breaks(profile, x, y, 0, 1);
      if (right || below) edges(x, y) = 1;
      if (right) edges(x + 1, y) = 1;
      if (below) edges(x, y + 1) = 1;
    }
  return edges;
}

Layer paleModel(const scene::Scene& scene, const study::Profile& profile) {
  const Look look = lookOf(scene, profile);
  const scene::Light light = modelLight(profile.camera, scene.up);
  shadow::LightMask lit;
  lit.light = image::GreyImage(profile.camera.width, profile.camera.height, 255);
  const shadow::CompositeOptions options{.ambient = 0.62, .background = Vec3(0.95, 0.965, 0.98)};
  const auto picture = shadow::composite(look.scene, look.surfaces, profile.camera, profile.surface,
                                         std::span(&light, 1), std::span(&lit, 1), options);
  Layer layer(picture.width(), picture.height());
  for (std::size_t i = 0; i < layer.size(); ++i) layer.pixels()[i] = toVec(picture.pixels()[i]);
  return layer;
}

void drawForm(Layer& layer, const image::GreyImage& formEdges) {
  constexpr float kShade = 0.26f, kFaintest = 0.25f;
  image::Image<float> edges(formEdges.width(), formEdges.height());
  std::copy(formEdges.pixels().begin(), formEdges.pixels().end(), edges.pixels().begin());
  // About 0.4 on a single edge, 1 where every pixel is one.
  const auto crowd = smoothed(smoothed(smoothed(edges)));
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (formEdges.pixels()[i] == 0) continue;
    const float strength = std::clamp((0.95f - crowd.pixels()[i]) / 0.45f, kFaintest, 1.0f);
    layer.pixels()[i] *= 1.0f - kShade * strength;
  }
}

image::Image<float> relief(const Layer& model) {
  image::Image<float> out(model.width(), model.height());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3f& c = model.pixels()[i];
    out.pixels()[i] = 0.7f + 0.3f * std::min(1.0f, 0.21f * c.x + 0.72f * c.y + 0.07f * c.z);
  }
  return out;
}

image::Image<float> castShadow(const study::Profile& profile, const study::ProfileStep& step,
                               const image::GreyImage& light, const scene::Scene& scene) {
  if (light.empty()) return {};
  const auto& surfaces = profile.geometry->surfaces;
  const Vec4 eye(profile.camera.eye - surfaces.origin, 1.0);
  const Vec4 sun(study::towardsSun(step.moment.sun, scene.up, scene.northOffset), 0.0);
  const auto facing = shadow::visibleSideFacesLight(surfaces, eye, sun);
  image::Image<float> shadow(light.width(), light.height());
  for (std::size_t i = 0; i < shadow.size(); ++i) {
    const std::uint32_t t = profile.surface.triangle.pixels()[i];
    if (t != shadow::kNoTriangle && facing[t] != 0) shadow.pixels()[i] = 1.0f - float(light.pixels()[i]) / 255.0f;
  }
  return shadow;
}

void stain(Layer& layer, const image::Image<float>& shadow, const Vec3f& colour, float strength) {
  for (std::size_t i = 0; i < shadow.size(); ++i)
    if (const float s = shadow.pixels()[i] * strength; s > 0.0f)
      layer.pixels()[i] *= Vec3f(1.0f) + s * (colour - Vec3f(1.0f));
}

image::Image<float> smoothed(const image::Image<float>& field) {
  // 1-4-6-4-1, once along and once across; the outermost two pixels stay as they are.
  const int w = field.width(), h = field.height();
  image::Image<float> along = field;
  const auto tap = [](float a, float b, float c, float d, float e) {
    return (a + e + 4.0f * (b + d) + 6.0f * c) / 16.0f;
  };
  for (int y = 0; y < h; ++y) {
    const float* in = field.row(y);
    float* out = along.row(y);
    for (int x = 2; x < w - 2; ++x) out[x] = tap(in[x - 2], in[x - 1], in[x], in[x + 1], in[x + 2]);
  }
  image::Image<float> across = along;
  for (int y = 2; y < h - 2; ++y) {
    const float *a = along.row(y - 2), *b = along.row(y - 1), *c = along.row(y), *d = along.row(y + 1),
                *e = along.row(y + 2);
    float* out = across.row(y);
    for (int x = 0; x < w; ++x) out[x] = tap(a[x], b[x], c[x], d[x], e[x]);
  }
  return across;
}

image::Image<float> solidBorders(const image::Image<float>& smoothedField) {
  // Smoothed over two pixels, the edge of an area has a slope of 0.2 a pixel, that of a bar three pixels wide 0.13, of one pixel 0.02.
  constexpr float kNone = 0.05f, kAll = 0.12f;
  const auto wide = smoothed(smoothed(smoothed(smoothedField)));
  image::Image<float> presence(wide.width(), wide.height());
  for (int y = 1; y + 1 < wide.height(); ++y)
    for (int x = 1; x + 1 < wide.width(); ++x) {
      const float gx = 0.5f * (wide(x + 1, y) - wide(x - 1, y)), gy = 0.5f * (wide(x, y + 1) - wide(x, y - 1));
      presence(x, y) = std::clamp((std::sqrt(gx * gx + gy * gy) - kNone) / (kAll - kNone), 0.0f, 1.0f);
    }
  return presence;
}

Lines::Lines(const image::GreyImage& formEdges, float width, float alpha)
    : formEdges_(formEdges), width_(width), alpha_(alpha), ink_(formEdges.width(), formEdges.height(), Vec4f(0.0f)) {}

void Lines::addBorder(const image::Image<float>& field, float level, const Vec3f& colour,
                      const image::Image<float>& presence) {
  constexpr float kFlat = 1e-3f;
  for (int y = 1; y + 1 < field.height(); ++y) {
    const float *above = field.row(y - 1), *here = field.row(y), *below = field.row(y + 1);
    for (int x = 1; x + 1 < field.width(); ++x) {
      const float gx = 0.5f * (here[x + 1] - here[x - 1]), gy = 0.5f * (below[x] - above[x]);
      const float slope2 = gx * gx + gy * gy;
      if (slope2 < kFlat * kFlat || formEdges_(x, y) != 0) continue;
      const float distance = std::abs(here[x] - level) / std::sqrt(slope2);
      const float present = presence.empty() ? alpha_ : alpha_ * presence(x, y);
      const float cover = std::clamp(0.5f * width_ + 0.5f - distance, 0.0f, 1.0f) * present;
      if (cover > 0.0f) ink_(x, y) = Vec4f(cover * colour, cover) + (1.0f - cover) * ink_(x, y);
    }
  }
}

void Lines::over(Layer& layer) const {
  for (std::size_t i = 0; i < layer.size(); ++i) {
    const Vec4f& ink = ink_.pixels()[i];
    if (ink.w > 0.0f) layer.pixels()[i] = Vec3f(ink) + (1.0f - ink.w) * layer.pixels()[i];
  }
}

}  // namespace umbrage::report::detail
