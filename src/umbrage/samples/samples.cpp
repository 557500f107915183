#include "umbrage/samples/samples.hpp"

#include <array>
#include <string>

#include "umbrage/samples/detail/scenes.hpp"

namespace umbrage::samples {
namespace {

struct Sample {
  SampleInfo info;
  scene::Scene (*build)();
};

constexpr std::array<Sample, 7> kSamples{{
    {{"courtyard", "A perimeter block around a court of 30 m with walls of 20 m, a kiosk and trees in it."},
     detail::courtyard},
    {{"tower", "A wrought-iron lattice tower of 300 m with curved legs: thousands of thin struts."}, detail::tower},
    {{"industrial", "An industrial site: halls, tanks, spheres, pipe racks, chimneys, a conveyor."},
     detail::industrial},
    {{"building", "An office tower of about 180,000 triangles: facade grid, slabs, concrete core."}, detail::building},
    {{"pavilion", "A stained-glass corner, a ball of glass and a smoked case with something inside: coloured light."},
     detail::pavilion},
    {{"cornell", "A white room with a red and a green wall, two blocks and a shining panel below its ceiling."},
     detail::cornell},
    {{"still_life", "Balls of glass and of silver on a chequered floor before a tall mirror."}, detail::stillLife},
}};

constexpr auto kInfos = [] {
  std::array<SampleInfo, kSamples.size()> infos{};
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kSamples[i].info;
  return infos;
}();

}  // namespace

std::span<const SampleInfo> list() { return kInfos; }

Result<scene::Scene> make(std::string_view name) {
  std::string known;
  for (const Sample& sample : kSamples) {
    if (sample.info.name == name) return sample.build();
    known += (known.empty() ? "" : ", ") + std::string(sample.info.name);
  }
  return fail(ErrorCode::usage, "there is no sample of this name; there are " + known, "sample:" + std::string(name));
}

}  // namespace umbrage::samples
