#pragma once

#include <span>
#include <vector>

#include "umbrage/scene/scene.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::shadow {

/// What the points of one triangle have in common when they are looked at; mostly the next is of the same.
struct Face {
  std::uint32_t triangle = kNoTriangle;
  Vec3 normal{0.0};  ///< unit, of either side
  const scene::Material* material = nullptr;
  Vec3 passing{0.0};  ///< what the material lets through
};

/// How a surface is turned where it is looked at.
struct Facing {
  Vec3 normal;            ///< unit, on the eye's side
  bool isSmooth = false;  ///< `normal` is not that of the facet, and may point away from a light that the facet faces
  double fade = 0.0;      ///< cosines to the light up to this are none
};

/// What surfaces look like by themselves under lights: the law that all pictures share (see composite). REQUIRES: outlived by all it is made of.
class Painter {
 public:
  Painter(const scene::Scene& scene, const scene::Surfaces& surfaces, std::span<const scene::Light> lights,
          const CompositeOptions& options);

  void turnTo(std::uint32_t triangle, Face& face) const {
    if (triangle == face.triangle) return;
    const scene::Material& material = scene_.materials[surfaces_.materials[triangle]];
    face = {triangle, glm::normalize(surfaces_.normal(triangle)), &material, scene::transmittance(material)};
  }
  /// `point`, relative to the origin of the surfaces, seen along `ray`.
  [[nodiscard]] Facing facing(const Face& face, const Vec3& point, const Vec3& ray) const {
    const double side = glm::dot(face.normal, ray) > 0.0 ? -1.0 : 1.0;
    return options_.smooth != nullptr ? smoothFacing(face.triangle, point, side) : Facing{side * face.normal};
  }
  /// Linear; `reach(i)`: what of light i gets there, per channel.
  template <class Reach>
  [[nodiscard]] Vec3 colour(const Face& face, const Vec3& point, const Vec3& ray, const Reach& reach) const {
    const Facing turned = facing(face, point, ray);
    Vec3 light(skyLight(options_.ambient, turned.normal, up_));
    for (std::size_t i = 0; i < lights_.size(); ++i)
      if (const Vec3 m = reach(i); m != Vec3(0.0)) light += m * received(lights_[i], point, turned);
    return face.material->emission + face.material->colour * light;
  }

 private:
  struct PreparedLight {
    Vec4 homogeneous;
    Vec3 radiance;  // colour x intensity
  };
  [[nodiscard]] static Vec3 received(const PreparedLight& light, const Vec3& point, const Facing& facing);
  [[nodiscard]] Facing smoothFacing(std::uint32_t triangle, const Vec3& point, double side) const;

  const scene::Scene& scene_;
  const scene::Surfaces& surfaces_;
  std::vector<PreparedLight> lights_;
  Vec3 up_;
  const CompositeOptions& options_;
};

}  // namespace umbrage::shadow
