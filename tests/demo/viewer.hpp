#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "display.hpp"

namespace umbrage::demo_test {

/// What a window shows of the scene, without the viewer's wheels and the lines of text.
struct View {
  image::RgbImage picture;
  [[nodiscard]] std::size_t count(const std::function<bool(const image::Rgb8&)>& like) const;
  [[nodiscard]] double brightness() const;  ///< mean of all channels
};
[[nodiscard]] bool isOrange(const image::Rgb8& pixel);  ///< the built-in object
[[nodiscard]] std::size_t differing(const View& a, const View& b);

/// Where the middle of the orange object stands, in pixels, and how many it has.
struct Spot {
  double x = 0, y = 0;
  std::size_t pixels = 0;
};
[[nodiscard]] Spot object(const View& view);

/// The demo in a window at the top left of a display of its own.
class ViewerTest : public testing::Test {
 protected:
  static constexpr int kWidth = 460, kHeight = 420;

  void SetUp() override;
  /// Starts the demo with these words more, and waits for its first picture.
  void start(std::vector<std::string> words = {});
  /// Presses a key and waits until the demo says this of it.
  void press(const std::string& key, const std::string& says);
  void enterAction() { press("Escape", "mode: action"); }
  /// Waits for a line that holds `text`, after all that was waited for before.
  [[nodiscard]] bool hears(const std::string& text);

  /// What is seen once it has come to rest. `left`: where the window stands.
  [[nodiscard]] View view(int left = 0) const;
  /// What is seen once it is no longer `before`; fails the test where it stays.
  [[nodiscard]] View changedFrom(const View& before, int left = 0) const;
  /// Waits until the same is seen again, to the last bit.
  void expectAgain(const View& view, int left = 0) const;

  [[nodiscard]] Display& display() { return *display_; }
  [[nodiscard]] Folder& folder() { return folder_; }
  [[nodiscard]] Process& demo() { return *demo_; }

 private:
  [[nodiscard]] static View crop(const image::RgbImage& screen, int left);
  Folder folder_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<Process> demo_;
  std::size_t heard_ = 0;
};

}  // namespace umbrage::demo_test
