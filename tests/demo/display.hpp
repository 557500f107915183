#pragma once

#include <memory>
#include <string>
#include <vector>

#include "process.hpp"
#include "umbrage/image/image.hpp"

namespace umbrage::demo_test {

/// An X display without a screen (Xvfb), with a mouse and keys (xdotool). It has no window manager: windows stand at the top left.
class Display {
 public:
  static constexpr int kWidth = 1280, kHeight = 800;

  /// What is missing on this machine to have one, or nothing.
  [[nodiscard]] static std::string missing();
  /// Null where it does not come up.
  [[nodiscard]] static std::unique_ptr<Display> open();

  /// What programs need in order to show their windows here.
  [[nodiscard]] std::vector<std::string> environment() const;
  /// What the screen shows.
  [[nodiscard]] image::RgbImage look() const;
  /// The same once it has not changed for a moment.
  [[nodiscard]] image::RgbImage lookCalmly() const;

  /// Presses keys, moves the mouse and so on: words of xdotool. What it prints.
  std::string act(const std::vector<std::string>& words) const;

 private:
  Display() = default;
  Folder folder_;
  std::string name_;
  std::unique_ptr<Process> server_;
};

}  // namespace umbrage::demo_test
