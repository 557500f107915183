#pragma once

#include <cstdint>

#include "umbrage/gl/host_scope.hpp"

namespace umbrage::gl {

/// Counts the samples that pass all tests while it lives; with every test off, the pixels that triangles cover.
/// REQUIRES: lives inside a HostScope and around whole passes; one at a time.
class SampleCount {
 public:
  explicit SampleCount(HostScope& scope);
  SampleCount(const SampleCount&) = delete;
  SampleCount& operator=(const SampleCount&) = delete;
  ~SampleCount();
  /// Ends the count; waits for the driver. REQUIRES: called once.
  [[nodiscard]] std::uint64_t stop();

 private:
  unsigned query_ = 0;
  bool running_ = true;
};

}  // namespace umbrage::gl
