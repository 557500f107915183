#pragma once

#include <string>
#include <vector>

#include "conformance/scenes/scenes.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::conformance {

/// Every technique of this build, the truth first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();

/// How one mask compares with the truth.
struct Verdict {
  std::string technique, scene, view, light;
  shadow::MaskDifference difference;
};

/// The sum over many masks.
struct Tally {
  std::size_t masks = 0, covered = 0, differing = 0, far = 0;
  void add(const Verdict& v) {
    ++masks;
    covered += v.difference.covered;
    differing += v.difference.differing;
    far += v.difference.farFromEdge;
  }
};

/// A technique ready for one scene, with the truth beside it.
class Judge {
 public:
  /// Errors: the technique's own, when it cannot run here.
  [[nodiscard]] static Result<Judge> make(const shadow::TechniqueEntry& entry,
                                          std::shared_ptr<const shadow::Geometry> geometry);

  /// One verdict a light. A differing pixel is far unless one of these holds:
  /// 1. a true edge (shadow::trueEdges) touches the pixel or one of its eight neighbours, as pixel centres and then 32 x 32 samples
  ///    a pixel show it;
  /// 2. the technique sees a triangle in front of what the truth sees, and that triangle passes within a pixel's width of the ray:
  ///    a hairline between all those samples;
  /// 3. the technique's answer is the exact one for a surface point displaced by at most 2^-15 of the depth along the view ray and
  ///    1/128 pixel across it. Depth in single precision, interpolated over triangles much larger than the screen, and corners
  ///    snapped to 1/256 pixel hold no more.
  [[nodiscard]] Result<std::vector<Verdict>> judge(const NamedView& view, const std::vector<NamedLight>& lights);

 private:
  struct Masks {
    const scene::Camera& camera;
    const scene::Light& light;
    const shadow::SurfaceBuffer& seen;  ///< by the technique
    const shadow::LightMask& mask;
  };
  [[nodiscard]] Result<bool> edgeNear(const Masks& m, int x, int y) const;
  [[nodiscard]] bool seesHairline(const Masks& m, const shadow::SurfaceBuffer& truth, int x, int y) const;
  [[nodiscard]] bool exactForDisplacedPoint(const Masks& m, const shadow::SurfaceBuffer& truth, int x, int y) const;

  std::string name_;
  int tolerance_ = 1;
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<shadow::Technique> technique_, truth_;
};

}  // namespace umbrage::conformance
