// Rent or buy: every edge is tested by brute force until that has cost about as much as building the tree would; then it is built,
// and so the sum is never much more than twice the best choice in hindsight, however many lights there will be. From then on the one
// that measured faster is asked, and the other again now and then. Where most edges are on the silhouette (a soup of single triangles)
// no tree can help, and none is built.
#include "umbrage/shadow/finders/automatic.hpp"

#include <algorithm>
#include <chrono>

namespace umbrage::shadow {
namespace {

constexpr int kTrials = 4;      // queries before a measurement is believed
constexpr int kTryAgain = 128;  // queries after which the loser is asked once more

}  // namespace

Automatic::Automatic(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : SilhouetteFinder(FinderKind::automatic, casters), options_(options), brute_(casters, options) {}

std::shared_ptr<const Hextree> Automatic::choose(Question question) const {
  {
    const std::lock_guard lock(mutex_);
    const auto& [brute, tree] = costs_[question];
    if (tree_ != nullptr) {
      if (tree.asked < kTrials) return tree_;
      if (brute.asked < kTrials) return nullptr;
      const bool treeIsBetter = tree.milliseconds < brute.milliseconds;
      const bool other = (brute.asked + tree.asked) % kTryAgain == 0;
      return treeIsBetter != other ? tree_ : nullptr;
    }
    if (rented_ < kRented || building_) return nullptr;
    building_ = true;
  }
  auto made = std::make_shared<const Hextree>(brute_.share(), options_);
  const std::lock_guard lock(mutex_);
  tree_ = std::move(made);
  return tree_;
}

void Automatic::book(Question question, bool tree, double milliseconds, std::size_t found) const {
  const std::lock_guard lock(mutex_);
  Cost& cost = costs_[question][tree ? 1 : 0];
  cost.milliseconds = cost.asked == 0 ? milliseconds : std::min(cost.milliseconds, milliseconds);
  ++cost.asked;
  if (found * 2 < casters().edges.size()) ++rented_;
}

template <class Answer>
auto Automatic::timed(Question question, const Answer& answer) const {
  const auto tree = choose(question);
  const auto start = std::chrono::steady_clock::now();
  auto result = answer(tree.get());
  const double passed = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  book(question, tree != nullptr, passed, result.edges.size());
  return result;
}

FoundEdges Automatic::find(const Vec4& light, const SilhouetteOptions& options) const {
  return timed(edgesAlone, [&](const Hextree* tree) {
    return tree != nullptr ? tree->find(light, options) : brute_.find(light, options);
  });
}

Silhouette Automatic::silhouette(const Vec4& light, const SilhouetteOptions& options) const {
  return timed(withSides, [&](const Hextree* tree) {
    if (tree == nullptr) return brute_.silhouette(light, options);
    return assemble(casters(), light, tree->find(light, options), brute_.sides(light, options));
  });
}

std::size_t Automatic::memory() const {
  const std::lock_guard lock(mutex_);
  return brute_.memory() + (tree_ != nullptr ? tree_->memory() : 0);
}

}  // namespace umbrage::shadow
