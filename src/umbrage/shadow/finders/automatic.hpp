#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "umbrage/shadow/finders/brute_force.hpp"
#include "umbrage/shadow/finders/hextree.hpp"

namespace umbrage::shadow {

/// Asks whichever finder measured faster on these casters. What it finds does not depend on the choice.
class Automatic final : public SilhouetteFinder {
 public:
  Automatic(std::shared_ptr<const CasterSet> casters, const FinderOptions& options);

  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] Silhouette silhouette(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// Queries by brute force that are paid for before a tree is built: about what building it costs.
  static constexpr int kRented = 100;

 private:
  enum Question { edgesAlone, withSides };
  struct Cost {
    int asked = 0;
    double milliseconds = 0.0;  ///< of one query; the lowest seen
  };
  /// The tree when it is to be asked, else null.
  [[nodiscard]] std::shared_ptr<const Hextree> choose(Question question) const;
  void book(Question question, bool tree, double milliseconds, std::size_t found) const;
  template <class Answer>
  auto timed(Question question, const Answer& answer) const;

  FinderOptions options_;
  BruteForceSimd brute_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Hextree> tree_;
  mutable bool building_ = false;
  mutable int rented_ = 0;
  mutable std::array<std::array<Cost, 2>, 2> costs_;  ///< [question][tree]
};

}  // namespace umbrage::shadow
