#include "umbrage/coin/detail/registry.hpp"

#include <Inventor/SoFullPath.h>
#include <Inventor/nodes/SoNode.h>

#include <algorithm>
#include <utility>

namespace umbrage::coin::detail {

void Unref::operator()(SoNode* node) const { node->unref(); }

NodeRef hold(SoNode* node) {
  if (node != nullptr) node->ref();
  return NodeRef(node);
}

Place::Place(const SoPath& path) : live_(path.copy()) {
  live_->ref();
  const auto& full = static_cast<const SoFullPath&>(path);
  for (int i = 0; i < full.getLength(); ++i) nodes_.push_back(hold(full.getNode(i)));
}

Place::Place(Place&& other) noexcept : nodes_(std::move(other.nodes_)), live_(std::exchange(other.live_, nullptr)) {}

Place& Place::operator=(Place&& other) noexcept {
  std::swap(nodes_, other.nodes_);
  std::swap(live_, other.live_);
  return *this;
}

Place::~Place() {
  if (live_ != nullptr) live_->unref();
}

bool Place::holds(const SoFullPath& path) const {
  const auto& live = static_cast<const SoFullPath&>(*live_);
  const bool whole = live.getLength() == static_cast<int>(nodes_.size());
  std::size_t met = 0;
  int last = -2;  // where the node before was met
  for (int i = 0; i < path.getLength() && met < nodes_.size(); ++i) {
    if (path.getNode(i) != nodes_[met].get()) continue;
    const bool sameChild = !whole || last != i - 1 || path.getIndex(i) == live.getIndex(static_cast<int>(met));
    if (!sameChild) return false;
    last = i;
    ++met;
  }
  return met == nodes_.size();
}

bool Place::is(const SoPath& path) const {
  const auto& full = static_cast<const SoFullPath&>(path);
  const auto& live = static_cast<const SoFullPath&>(*live_);
  if (full.getLength() != static_cast<int>(nodes_.size()) || live.getLength() != full.getLength()) return false;
  for (int i = 0; i < full.getLength(); ++i)
    if (full.getNode(i) != live.getNode(i) || (i > 0 && full.getIndex(i) != live.getIndex(i))) return false;
  return true;
}

bool Registry::casts(const SoFullPath& shape) const {
  if (everything) return true;
  for (const NodeRef& object : objects)
    for (int i = 0; i < shape.getLength(); ++i)
      if (shape.getNode(i) == object.get()) return true;
  return std::ranges::any_of(places, [&](const Place& place) { return place.holds(shape); });
}

bool Registry::shadows(const SoNode& light) const {
  return everything || std::ranges::any_of(lights, [&](const NodeRef& known) { return known.get() == &light; });
}

}  // namespace umbrage::coin::detail
