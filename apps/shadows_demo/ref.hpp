#pragma once

#include <Inventor/nodes/SoNode.h>

#include <memory>

namespace umbrage::demo {

struct Unref {
  void operator()(SoNode* node) const { node->unref(); }
};

/// Keeps a node of Coin.
template <class Node>
using Ref = std::unique_ptr<Node, Unref>;

template <class Node>
[[nodiscard]] Ref<Node> hold(Node* node) {
  node->ref();
  return Ref<Node>(node);
}

}  // namespace umbrage::demo
