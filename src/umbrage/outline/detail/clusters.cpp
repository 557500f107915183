#include "umbrage/outline/detail/clusters.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace umbrage::outline::detail {
namespace {

std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

std::vector<std::vector<std::size_t>> clusters(const std::vector<Extent>& extents) {
  std::vector<std::size_t> order, parents(extents.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (std::size_t i = 0; i < extents.size(); ++i)
    if (!extents[i].empty()) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return extents[a].min.x < extents[b].min.x; });
  std::vector<std::size_t> open;  // those that reach to where the sweep is
  for (const std::size_t i : order) {
    std::erase_if(open, [&](std::size_t j) { return extents[j].max.x < extents[i].min.x; });
    for (const std::size_t j : open)
      if (extents[i].touches(extents[j])) parents[rootOf(parents, i)] = rootOf(parents, j);
    open.push_back(i);
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < extents.size(); ++i)
    if (!extents[i].empty()) members[rootOf(parents, i)].push_back(i);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [root, list] : members) result.push_back(std::move(list));
  return result;
}

}  // namespace umbrage::outline::detail
