#pragma once

#include <memory>
#include <vector>

class SoNode;
class SoPath;

namespace umbrage::coin::detail {

/// Keeps a node of Coin alive.
struct Unref {
  void operator()(SoNode* node) const;
};
using NodeRef = std::unique_ptr<SoNode, Unref>;
[[nodiscard]] NodeRef hold(SoNode* node);

/// One place of a node, told by the nodes above it.
class Place {
 public:
  /// REQUIRES: a path that is not empty.
  explicit Place(const SoPath& path);
  Place(Place&&) noexcept;
  Place& operator=(Place&&) noexcept;
  ~Place();

  /// Whether `path` passes through the place: its nodes are met in order, whatever stands before and between; where the way has not been cut since,
  /// as the children that they were.
  [[nodiscard]] bool holds(const SoPath& path) const;
  [[nodiscard]] bool is(const SoPath& path) const;

 private:
  std::vector<NodeRef> nodes_;
  SoPath* live_;  ///< kept up to date by Coin; shorter than nodes_ when a node was taken out of its parent
};

/// Which lights and shapes cast.
struct Registry {
  bool everything = false;  ///< all of them
  std::vector<NodeRef> lights, objects;
  std::vector<Place> places;

  [[nodiscard]] bool casts(const SoPath& shape) const;
  [[nodiscard]] bool shadows(const SoNode& light) const;
};

}  // namespace umbrage::coin::detail
