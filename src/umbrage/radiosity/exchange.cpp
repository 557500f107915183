#include "umbrage/radiosity/detail/exchange.hpp"

#include <algorithm>

#include "umbrage/parallel/for_each.hpp"

namespace umbrage::radiosity::detail {
namespace {

constexpr std::size_t kBlock = 256;

}  // namespace

Exchange::Exchange(const trace::Occlusion& occlusion, const Subdivision& mesh, const Patches& patches,
                   const VisibilityAccuracy& accuracy, std::size_t memory)
    : occlusion_(occlusion),
      mesh_(mesh),
      patches_(patches),
      accuracy_(accuracy),
      room_(memory / sizeof(Factor)),
      columns_(2 * patches.count()),
      known_(mesh.vertices().size()) {}

Emitter Exchange::emitterOf(Side emitter) const {
  const Element& element = mesh_.elements()[patches_.element(emitter / 2)];
  const Vec3 normal = mesh_.sheetOf(element).normal;
  const Vec3 centre = mesh_.vertices()[element.centre].position;
  return {mesh_.corners(element), emitter % 2 == 0 ? normal : -normal, liftOf(occlusion_, element.triangle, centre)};
}

Result<std::vector<Factor>> Exchange::compute(Side emitter) const {
  const Emitter from = emitterOf(emitter);
  std::vector<std::vector<Factor>> blocks((known_ + kBlock - 1) / kBlock);
  const auto done = parallel::forEach(static_cast<int>(blocks.size()), [&](int block) {
    const std::size_t begin = static_cast<std::size_t>(block) * kBlock, end = std::min(known_, begin + kBlock);
    auto& own = blocks[static_cast<std::size_t>(block)];
    for (std::size_t v = begin; v < end; ++v)
      factors(from, static_cast<std::uint32_t>(v), [&](Side receiver, double factor) {
        own.push_back({receiver, static_cast<float>(factor)});
      });
  });
  if (!done) return tl::unexpected(done.error());
  std::vector<Factor> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

Result<std::span<const Factor>> Exchange::from(Side emitter) {
  Column& column = columns_[emitter];
  if (column.kept) return std::span<const Factor>(column.factors);
  auto computed = compute(emitter);
  if (!computed) return tl::unexpected(computed.error());
  computed_ += computed->size();
  if (computed->size() > room_) {
    passing_ = std::move(*computed);
    return std::span<const Factor>(passing_);
  }
  room_ -= computed->size();
  column = {true, std::move(*computed)};
  return std::span<const Factor>(column.factors);
}

void Exchange::add(Side emitter, Factor factor) {
  ++computed_;
  Column& column = columns_[emitter];
  if (!column.kept) return;
  if (room_ == 0) {
    // What is kept must be whole.
    room_ += column.factors.size();
    column = {};
    return;
  }
  --room_;
  column.factors.push_back(factor);
}

}  // namespace umbrage::radiosity::detail
