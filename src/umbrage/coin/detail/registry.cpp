#include "umbrage/coin/detail/registry.hpp"

#include <Inventor/nodes/SoNode.h>

#include <algorithm>
#include <utility>

#include "umbrage/inventor/full_path.hpp"

namespace umbrage::coin::detail {

using inventor::FullPath;

void Unref::operator()(SoNode* node) const { node->unref(); }

NodeRef hold(SoNode* node) {
  if (node != nullptr) node->ref();
  return NodeRef(node);
}

Place::Place(const SoPath& path) : live_(path.copy()) {
  live_->ref();
  const FullPath full(path);
  for (int i = 0; i < full.length(); ++i) nodes_.push_back(hold(full.node(i)));
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

bool Place::holds(const SoPath& given) const {
  const FullPath path(given), live(*live_);
  const bool whole = live.length() == static_cast<int>(nodes_.size());
  std::size_t met = 0;
  int last = -2;  // where the node before was met
  for (int i = 0; i < path.length() && met < nodes_.size(); ++i) {
    if (path.node(i) != nodes_[met].get()) continue;
    const bool sameChild = !whole || last != i - 1 || path.index(i) == live.index(static_cast<int>(met));
    if (!sameChild) return false;
    last = i;
    ++met;
  }
  return met == nodes_.size();
}

bool Place::is(const SoPath& path) const {
  const FullPath full(path), live(*live_);
  if (full.length() != static_cast<int>(nodes_.size()) || live.length() != full.length()) return false;
  for (int i = 0; i < full.length(); ++i)
    if (full.node(i) != live.node(i) || (i > 0 && full.index(i) != live.index(i))) return false;
  return true;
}

bool Registry::casts(const SoPath& path) const {
  if (everything) return true;
  const FullPath shape(path);
  for (const NodeRef& object : objects)
    for (int i = 0; i < shape.length(); ++i)
      if (shape.node(i) == object.get()) return true;
  return std::ranges::any_of(places, [&](const Place& place) { return place.holds(path); });
}

bool Registry::shadows(const SoNode& light) const {
  return everything || std::ranges::any_of(lights, [&](const NodeRef& known) { return known.get() == &light; });
}

}  // namespace umbrage::coin::detail
