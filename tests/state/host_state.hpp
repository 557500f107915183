#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace umbrage::state {

/// Every piece of a host's OpenGL state that drawing could disturb, by name.
using Snapshot = std::map<std::string, std::vector<double>>;

/// A host that leaves its context in one wild but legal state after the other. REQUIRES: a context is current.
class WildHost {
 public:
  explicit WildHost(bool compatibility);
  /// Sets everything that snapshot() reads to something legal and random.
  void randomise(std::uint32_t seed);
  [[nodiscard]] Snapshot snapshot() const;
  /// Of the host's framebuffers, which have depth and 8 bits of stencil.
  static constexpr int kSize = 64;

 private:
  void randomiseSwitches();
  void randomiseTests();
  void randomiseRaster();
  void randomiseBindings();
  int number(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool coin() { return number(0, 1) == 1; }
  unsigned pick(const std::vector<unsigned>& of) { return of[static_cast<std::size_t>(number(0, int(of.size()) - 1))]; }

  bool compatibility_;
  std::mt19937 random_;
  std::vector<unsigned> buffers_, textures2d_, textures3d_, samplers_, vertexArrays_, framebuffers_, programs_,
      pipelines_;
};

/// Names whose values differ, with both values.
[[nodiscard]] std::string difference(const Snapshot& before, const Snapshot& after);

}  // namespace umbrage::state
