#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/settings.hpp"

class SoSeparator;

namespace umbrage::coin::detail {

enum class Caps {
  none,  ///< sides alone, which show a volume without fighting with the surfaces that caps lie on
  both   ///< volumes are closed
};

/// Shadow volumes as nodes of Coin, to be drawn translucent or written to files. A volume depends on its caster, on how that is turned and scaled, and
/// on the light as seen from it: under a directional light a caster that only moves along keeps its volume, which is then moved.
class VolumeMaker {
 public:
  VolumeMaker();
  VolumeMaker(const VolumeMaker&) = delete;
  VolumeMaker& operator=(const VolumeMaker&) = delete;
  ~VolumeMaker();

  /// A graph of the volumes of every caster and light, in the coordinates that the scan calls the world; null where there is none. It belongs to
  /// this and is made anew by the next call. `work`: volumes and volumesReused are counted.
  [[nodiscard]] SoSeparator* build(const Scan& scan, const Settings& settings, Caps caps, Work& work);

 private:
  struct Key;
  struct Made;
  [[nodiscard]] Made& volumeOf(const std::shared_ptr<const mesh::Mesh>& mesh, const Mat4& toWorld, const Vec4& light,
                               const Settings& settings, Caps caps, Work& work);
  std::vector<Made> made_;
  std::size_t turn_ = 0;
  NodeRef root_;
};

}  // namespace umbrage::coin::detail
