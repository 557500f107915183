#pragma once

#include <string>
#include <vector>

namespace umbrage::gl {

/// Collects what the driver complains about (errors, deprecated and undefined behaviour) while it lives: for tests, in a
/// context made with ContextOptions::debug. REQUIRES: one context stays current; no other DebugLog lives in it.
class DebugLog {
 public:
  DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;
  ~DebugLog();

  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }
  void add(std::string message) { messages_.push_back(std::move(message)); }

 private:
  std::vector<std::string> messages_;
};

}  // namespace umbrage::gl
