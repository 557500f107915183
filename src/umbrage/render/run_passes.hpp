#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "umbrage/gl/pass.hpp"
#include "umbrage/render/gpu_frame.hpp"
#include "umbrage/render/gpu_scene.hpp"
#include "umbrage/render/pass_list.hpp"
#include "umbrage/render/prepare_light.hpp"

namespace umbrage::render {

/// The programs of a context, each compiled when it is first used.
class Programs {
 public:
  /// REQUIRES: not Shader::none.
  [[nodiscard]] const gl::Program& get(Shader shader);

 private:
  std::array<std::optional<gl::Program>, static_cast<std::size_t>(Shader::encode) + 1> programs_;
};

/// One light's data on the graphics card.
struct GpuLight {
  gl::Buffer view, shading, facing, volume, farPoints, points;
  gl::Buffer inPicture, nearPoints;  ///< for VolumeGroup::nearCasters: a view that changes nothing, and their points
  gl::VertexArray vertices{volume};
  std::vector<VolumeGroup> groups;
  bool onCard = false;  ///< the volumes are `card`, not the groups' ranges
  CardVolume card;
};

/// What the steps of a PassList refer to. Pointers may be null where no step needs them.
struct RunInput {
  Programs& programs;
  const gl::Buffer& positions;
  const GpuScene* scene = nullptr;
  const GpuFrame* frame = nullptr;
  const gl::Buffer* materials = nullptr;
  const gl::Buffer* view = nullptr;     ///< for steps of no light
  const gl::Buffer* shading = nullptr;  ///< likewise
  const std::vector<GpuLight>& lights;
};

/// Executes a plan. `ended` is called, after a finish, whenever a phase ends; without it nothing waits.
void run(gl::HostScope& scope, const PassList& list, const RunInput& input, const PhaseEnd& ended = {});

/// Per light: the pixels that the triangles of its volumes cover where `list` draws them, each triangle by itself. Draws them again without any
/// test and writes nothing. Waits for the driver. REQUIRES: `list` has been run with this input.
[[nodiscard]] std::vector<std::uint64_t> countFragments(gl::HostScope& scope, const PassList& list,
                                                        const RunInput& input);

}  // namespace umbrage::render
