#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/radiosity/detail/patches.hpp"
#include "umbrage/radiosity/visible_factor.hpp"

namespace umbrage::radiosity::detail {

/// One side of a patch, or of a vertex: twice its number, and the side.
using Side = std::uint32_t;

/// The form factor from a side of a vertex to some side of a patch.
struct Factor {
  Side receiver;
  float factor;
};

/// Form factors between patches and vertices, kept as far as memory allows.
class Exchange {
 public:
  /// REQUIRES: outlived by all of these.
  Exchange(const trace::Occlusion& occlusion, const Subdivision& mesh, const Patches& patches,
           const VisibilityAccuracy& accuracy, std::size_t memory);

  /// Of a side of a patch, all that are not 0; valid until the next call. Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<std::span<const Factor>> from(Side emitter);

  /// Calls take(emitter, factor) for all sides of patches in `emitters` that a side of a vertex sees. May be called in many threads at once.
  template <class Fn>
  void to(std::uint32_t vertex, std::span<const Side> emitters, const Fn& take) const {
    for (const Side emitter : emitters)
      factors(emitterOf(emitter), vertex, [&](Side receiver, double factor) { take(emitter, receiver, factor); });
  }
  /// Adds a factor of a new vertex to those that are kept. In the order of vertices.
  void add(Side emitter, Factor factor);
  /// From now on vertices up to `count` are known.
  void grow(std::size_t count) { known_ = count; }

  /// How many factors that are not 0 were computed.
  [[nodiscard]] std::size_t computed() const { return computed_; }
  [[nodiscard]] Emitter emitterOf(Side emitter) const;

 private:
  template <class Fn>
  void factors(const Emitter& emitter, std::uint32_t vertex, const Fn& take) const;
  [[nodiscard]] Result<std::vector<Factor>> compute(Side emitter) const;

  struct Column {
    bool kept = false;
    std::vector<Factor> factors;
  };
  const trace::Occlusion& occlusion_;
  const Subdivision& mesh_;
  const Patches& patches_;
  VisibilityAccuracy accuracy_;
  std::size_t room_;  ///< factors that may still be kept
  std::vector<Column> columns_;
  std::vector<Factor> passing_;
  std::size_t known_ = 0, computed_ = 0;
};

template <class Fn>
void Exchange::factors(const Emitter& emitter, std::uint32_t vertex, const Fn& take) const {
  const Vertex& v = mesh_.vertices()[vertex];
  const Vec3 normal = mesh_.sheets()[v.sheet].normal;
  double highest = 0.0, lowest = 0.0;
  for (const Vec3& corner : emitter.corner) {
    const double height = glm::dot(corner - v.sample, normal);
    highest = std::max(highest, height), lowest = std::min(lowest, height);
  }
  const double lift = liftOf(occlusion_, v.triangle, v.sample);
  if (highest > lift)
    if (const double f = visibleFactor(occlusion_, {v.sample, normal, lift}, emitter, accuracy_); f > 0.0)
      take(2 * vertex, f);
  if (lowest < -lift)
    if (const double f = visibleFactor(occlusion_, {v.sample, -normal, lift}, emitter, accuracy_); f > 0.0)
      take(2 * vertex + 1, f);
}

}  // namespace umbrage::radiosity::detail
