#include <algorithm>

#include "umbrage/radiosity/detail/patches.hpp"
#include "umbrage/trace/segment.hpp"

namespace umbrage::radiosity::detail {
namespace {

constexpr std::size_t kMost = 1'000'000;

}  // namespace

Result<Patches> Patches::cut(Subdivision& mesh, const Box3& near, double size, bool onceMore) {
  Patches patches;
  const auto tooLarge = [&](const Element& element) {
    if (mesh.elements().size() > 2 * kMost) return false;
    const double edge = mesh.longestEdge(element);
    const double away = trace::distanceToBox(mesh.vertices()[element.centre].position, near) - edge;
    return edge > std::max(size, away);
  };
  const auto roots = static_cast<std::uint32_t>(mesh.elements().size());
  for (std::uint32_t root = 0; root < roots; ++root) mesh.splitWhile(root, tooLarge);
  for (std::uint32_t root = 0; root < roots; ++root)
    mesh.forEachLeaf(root, [&](std::uint32_t leaf) { patches.elements_.push_back(leaf); });
  if (patches.count() > kMost)
    return fail(ErrorCode::input, "would be cut into more than a million patches: a larger --patch is needed");
  for (const std::uint32_t element : patches.elements_) {
    patches.areas_.push_back(mesh.area(mesh.elements()[element]));
    if (onceMore) mesh.split(element);
  }
  patches.weigh(mesh);
  return patches;
}

void Patches::weigh(const Subdivision& mesh) {
  first_.assign(1, 0);
  weights_.clear();
  std::vector<Weight> own;
  for (std::size_t p = 0; p < count(); ++p) {
    own.clear();
    mesh.forEachLeaf(elements_[p], [&](std::uint32_t leaf) {
      const Element& element = mesh.elements()[leaf];
      const double part = mesh.area(element) / areas_[p];
      own.push_back({element.centre, 0.75 * part});
      for (const std::uint32_t corner : element.corner) own.push_back({corner, part / 12.0});
    });
    std::ranges::stable_sort(own, {}, &Weight::vertex);
    for (const Weight& weight : own) {
      if (weights_.size() > first_.back() && weights_.back().vertex == weight.vertex)
        weights_.back().weight += weight.weight;
      else
        weights_.push_back(weight);
    }
    first_.push_back(weights_.size());
  }
}

}  // namespace umbrage::radiosity::detail
