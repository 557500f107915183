#pragma once

#include <memory>
#include <span>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/shadow/painter.hpp"
#include "umbrage/trace/transmission.hpp"

namespace umbrage::optics {

struct Options {
  int reflections = 0;  ///< at most so many mirrors one after the other
  int refractions =
      0;  ///< at most so many interfaces that bend light, or throw it back from within, one after the other; 0: light goes straight on
  std::size_t lightSamples = 64;  ///< points of each light that has an extent
  shadow::CompositeOptions look = {};
};

/// Light along rays that mirrors and clear solids turn.
///
/// 1. With no reflections and no refractions it is what composite() shows of exact masks.
/// 2. A surface shows (1 - mirror) of its own look and `mirror` of what it reflects, in its colour.
/// 3. Where a material has an index of refraction above 1, what passes is bent (Snell) and a part is reflected (Fresnel); the two are all there is of
///    what is not opaque. Every surface takes its filter from what passes.
/// 4. Where the depth ends, a mirror has its own look, an interface reflects nothing and lets all pass straight on, and light that could only be
///    thrown back inside is none.
/// 5. A solid is left where one of its instance's surfaces is met from within; who looks from inside sees so too.
/// CAVEAT: shadows behind clear solids are those of straight light in their colour; there are no caustics.
/// Source: T. Whitted, An improved illumination model for shaded display, 1980.
class Tracer {
 public:
  /// Errors: ErrorCode::device when memory runs out or rays cannot be had. REQUIRES: scene, lights and what options name outlive it.
  [[nodiscard]] static Result<Tracer> build(const scene::Scene& scene, std::shared_ptr<const shadow::Geometry> geometry,
                                            std::span<const scene::Light> lights, const Options& options);

  /// Linear, what comes from there along a ray. `from` is relative to the origin of the surfaces. May be asked in many threads at once.
  [[nodiscard]] Vec3 colour(const Vec3& from, const Vec3& direction) const {
    return along({from, direction, inside(from)});
  }

  /// The same of many rays from one place.
  class From {
   public:
    [[nodiscard]] Vec3 colour(const Vec3& direction) const { return tracer_.along({from_, direction, inside_}); }

   private:
    friend class Tracer;
    From(const Tracer& tracer, const Vec3& from) : tracer_(tracer), from_(from), inside_(tracer.inside(from)) {}
    const Tracer& tracer_;
    Vec3 from_;
    std::vector<std::uint32_t> inside_;
  };
  [[nodiscard]] From from(const Vec3& place) const { return {*this, place}; }

 private:
  struct Ray {
    Vec3 from, direction;
    std::vector<std::uint32_t> inside =
        {};                      ///< triangles by which solids were entered, or any of theirs; the last is the medium
    int mirrored = 0, bent = 0;  ///< so far
    double weight = 1.0;         ///< what it counts for at most
  };
  struct LightPoints {
    std::vector<shadow::LightSample> samples;
    std::vector<Vec4> at;  ///< homogeneous, relative to the origin of the surfaces
  };
  /// Where a ray meets a surface.
  struct Meeting {
    shadow::Face face;
    Vec3 point;
    Vec3 normal;  ///< that light goes by; on the ray's side
  };

  Tracer(const scene::Scene& scene, trace::Transmission rays, std::span<const scene::Light> lights,
         const Options& options);

  [[nodiscard]] Vec3 along(const Ray& ray) const;
  [[nodiscard]] Vec3 atInterface(const Ray& ray, const Meeting& at, const Vec3& own) const;
  [[nodiscard]] std::vector<std::uint32_t> beyond(const Ray& ray, std::uint32_t triangle) const;
  [[nodiscard]] bool isThrownBack(const Ray& ray, const Meeting& at) const;
  [[nodiscard]] Vec3 ownLook(const Ray& ray, const Meeting& at) const;
  [[nodiscard]] Vec3 lit(std::size_t light, const Vec3& from, const Meeting& at) const;
  [[nodiscard]] Meeting meet(const Ray& ray, const trace::Hit& hit) const;
  [[nodiscard]] Ray turned(const Ray& ray, const Meeting& at, const Vec3& direction, double weight) const;
  [[nodiscard]] std::vector<std::uint32_t> inside(const Vec3& point) const;
  [[nodiscard]] double medium(const std::vector<std::uint32_t>& inside) const;
  [[nodiscard]] const scene::Surfaces& surfaces() const { return rays_.geometry().surfaces; }

  const scene::Scene& scene_;
  trace::Transmission rays_;
  std::unique_ptr<const Options> options_;  ///< stays where it is: the painter refers to it
  shadow::Painter painter_;
  std::vector<LightPoints> lights_;
  std::vector<std::uint32_t> solids_;  ///< triangles that bend light, by instance
  Vec3 background_;
};

/// The picture that a camera sees of a tracer's scene.
/// Errors: ErrorCode::device when memory runs out or rays cannot be had.
[[nodiscard]] Result<image::RgbImage> paint(const scene::Scene& scene,
                                            const std::shared_ptr<const shadow::Geometry>& geometry,
                                            const scene::Camera& camera, std::span<const scene::Light> lights,
                                            const Options& options);

}  // namespace umbrage::optics
