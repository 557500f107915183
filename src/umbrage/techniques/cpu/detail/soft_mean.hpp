#pragma once

#include <span>
#include <vector>

#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

/// The mean of hard masks of one light, with an estimate of its error.
class SoftMean {
 public:
  /// `seen`: what the camera sees, with its veils; outlives this.
  SoftMean(const scene::Camera& camera, const shadow::Shading& seen);

  /// REQUIRES: one mask a sample, all for the same picture. Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> add(std::span<const shadow::LightSample> samples,
                                 std::span<const shadow::LightMask> masks);

  [[nodiscard]] std::size_t samples() const { return samples_; }
  /// As SoftStats has it; infinite before both halves have samples.
  [[nodiscard]] double error() const;
  [[nodiscard]] shadow::LightMask mask() const;
  [[nodiscard]] shadow::SoftStats stats() const;

 private:
  /// Sums of every other group of samples: by themselves each half fills the light as evenly.
  struct Half {
    std::vector<Vec3f> light;   ///< per pixel, then per veil
    std::vector<float> weight;  ///< the same; empty where each sample counts 1
    std::size_t samples = 0;
  };
  void addTo(Half& half, const shadow::LightSample& sample, const shadow::LightMask& mask, int y) const;
  void addAt(Half& half, std::size_t place, const Vec3f& light, const shadow::LightSample& sample, int x, int y,
             double depth) const;
  [[nodiscard]] float weightAt(const Half& half, std::size_t place) const;
  [[nodiscard]] Vec3f meanAt(std::size_t place) const;

  scene::Camera camera_;
  scene::PixelRays rays_;
  const shadow::Shading& seen_;
  std::size_t samples_ = 0;
  bool tinted_ = false;
  image::GreyImage covered_;
  Half halves_[2];
};

}  // namespace umbrage::techniques::detail
