#pragma once

#include <string>
#include <vector>

#include "conformance/scenes/scenes.hpp"
#include "umbrage/shadow/edge_finder.hpp"

namespace umbrage::conformance {

/// Every technique of this build that is not approximate, the truth first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();
/// What a technique is judged by: one that sees through surfaces, where there are such, by rays that do so too.
[[nodiscard]] shadow::TechniqueEntry truthFor(const shadow::TechniqueEntry& entry, const shadow::Geometry& geometry);

/// Ways of zfail and zpass that are asked for, by compute shaders and by other extrusions; no pixel may depend on them.
[[nodiscard]] std::vector<shadow::TechniqueEntry> askedWays();

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

  /// One verdict a light. A differing pixel is far unless an edge of the truth's own mask touches one of its neighbours, or
  /// shadow::EdgeFinder finds a true edge near it. Pixels where the technique says that it knows no shadows are not judged.
  [[nodiscard]] Result<std::vector<Verdict>> judge(const NamedView& view, const std::vector<NamedLight>& lights);

 private:
  std::string name_;
  int tolerance_ = 1;
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<shadow::Technique> technique_;
  std::shared_ptr<shadow::Technique> truth_;
  std::unique_ptr<shadow::EdgeFinder> edges_;
};

}  // namespace umbrage::conformance
