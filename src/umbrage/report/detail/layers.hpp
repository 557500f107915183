#pragma once

#include "umbrage/image/image.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report::detail {

/// A picture in the making: display-coded channels in [0, 1].
using Layer = image::Image<Vec3f>;

[[nodiscard]] Vec3f toVec(image::Rgb8 colour);
[[nodiscard]] image::RgbImage toRgb(const Layer& layer);

/// The scene as a pale model under an even sun without shadows; parts of the profile in their colours.
[[nodiscard]] Layer paleModel(const scene::Scene& scene, const study::Profile& profile);

/// How much the form shows in a heat map: 1 on the brightest surface, less on those turned away from the view's light.
[[nodiscard]] image::Image<float> relief(const Layer& model);

/// Nonzero where neighbouring pixels lie on surfaces that do not continue each other: another depth, or a crease.
[[nodiscard]] image::GreyImage formEdges(const study::Profile& profile);

/// Draws the edges of form thinly; where they crowd, fainter, so that fine grids do not turn black.
void drawForm(Layer& layer, const image::GreyImage& formEdges);

/// How much of each pixel a cast shadow covers, 0..1: where the surface faces the sun and no sun comes. Empty at night.
/// `light`: the step's mask, of all casters or of one part.
[[nodiscard]] image::Image<float> castShadow(const study::Profile& profile, const study::ProfileStep& step,
                                             const image::GreyImage& light, const scene::Scene& scene);

/// Darkens the layer towards `colour` where the shadow lies; repeated layers deepen.
void stain(Layer& layer, const image::Image<float>& shadow, const Vec3f& colour, float strength);

/// The field smoothed over about a pixel, so that its borders have a slope.
[[nodiscard]] image::Image<float> smoothed(const image::Image<float>& field);

/// Where a border of a smoothed field bounds an area and not a speck or a bar thinner than two pixels: 0..1. Outlines of a lattice's
/// shadow would hide the shadow.
[[nodiscard]] image::Image<float> solidBorders(const image::Image<float>& smoothedField);

/// Lines to be laid over a layer, the later over the earlier.
class Lines {
 public:
  /// `width` in pixels; `formEdges`: where no line is drawn, since it would repeat an edge of form.
  Lines(const image::GreyImage& formEdges, float width, float alpha);

  /// Draws the border of a smoothed field at `level` as a smooth line, only so far as `presence` (1 everywhere if empty) has it.
  void addBorder(const image::Image<float>& field, float level, const Vec3f& colour,
                 const image::Image<float>& presence = {});
  void over(Layer& layer) const;

 private:
  const image::GreyImage& formEdges_;
  float width_, alpha_;
  image::Image<Vec4f> ink_;  // colour x cover, cover
};

}  // namespace umbrage::report::detail
