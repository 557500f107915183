#include "viewer.hpp"

#include "umbrage/image/compare.hpp"

namespace umbrage::demo_test {
namespace {

// Around the picture are wheels, buttons and text.
constexpr int kSide = 36, kAbove = 2, kBelow = 92;

}  // namespace

bool isOrange(const image::Rgb8& pixel) { return pixel.r > 60 && pixel.r > 1.6 * pixel.g && pixel.r > 2 * pixel.b; }

std::size_t View::count(const std::function<bool(const image::Rgb8&)>& like) const {
  std::size_t found = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) found += like(picture(x, y));
  return found;
}

double View::brightness() const {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sum += picture(x, y).r + picture(x, y).g + picture(x, y).b;
  return sum / (3.0 * picture.width() * picture.height());
}

std::size_t differing(const View& a, const View& b) { return image::compare(a.picture, b.picture).pixels; }

Spot object(const View& view) {
  Spot spot;
  for (int y = 0; y < view.picture.height(); ++y) {
    for (int x = 0; x < view.picture.width(); ++x) {
      if (!isOrange(view.picture(x, y))) continue;
      spot.x += x;
      spot.y += y;
      ++spot.pixels;
    }
  }
  const auto count = static_cast<double>(std::max<std::size_t>(spot.pixels, 1));
  return {spot.x / count, spot.y / count, spot.pixels};
}

void ViewerTest::SetUp() {
  if (const auto missing = Display::missing(); !missing.empty())
    GTEST_SKIP() << "no windows here: " << missing << " is missing (scripts/deps)";
  display_ = Display::open();
  ASSERT_NE(display_, nullptr) << "Xvfb does not come up";
}

void ViewerTest::start(std::vector<std::string> words) {
  words.insert(words.begin(), {UMBRAGE_DEMO, "--verbose", "--folder", folder_.text(), "--size",
                               std::to_string(kWidth) + "x" + std::to_string(kHeight)});
  // Out of the picture, but over the window, which then has the keys.
  display_->act({"mousemove", "200", std::to_string(kHeight - 8)});
  demo_.reset();
  heard_ = 0;
  demo_ = std::make_unique<Process>(words, display_->environment(), folder_ / "said");
  ASSERT_TRUE(hears("picture ")) << demo_->said();
  // It is drawn again when the window has its size.
  ASSERT_TRUE(eventually([&] { return view().count([](const image::Rgb8& p) { return p.r > 80; }) > 20000; }));
}

bool ViewerTest::hears(const std::string& text) {
  if (HasFatalFailure()) return false;
  return eventually([&] {
    const std::string said = demo_->said();
    const auto at = said.find(text, heard_);
    if (at == std::string::npos) return !demo_->runs() && (demo_->wait(), false);
    heard_ = at + text.size();
    return true;
  });
}

void ViewerTest::press(const std::string& key, const std::string& says) {
  display_->act({"key", key});
  ASSERT_TRUE(hears(says)) << key << " does not do it: " << says << "\n" << demo_->said();
}

View ViewerTest::crop(const image::RgbImage& screen, int left) {
  View view{image::RgbImage(kWidth - 2 * kSide, kHeight - kAbove - kBelow)};
  for (int y = 0; y < view.picture.height(); ++y)
    for (int x = 0; x < view.picture.width(); ++x) view.picture(x, y) = screen(left + kSide + x, kAbove + y);
  return view;
}

View ViewerTest::view(int left) const { return crop(display_->lookCalmly(), left); }

View ViewerTest::changedFrom(const View& before, int left) const {
  View now = before;
  if (HasFatalFailure()) return now;
  const bool changed = eventually([&] {
    now = view(left);
    return differing(before, now) > 0;
  });
  EXPECT_TRUE(changed) << "nothing changes in the picture";
  return now;
}

void ViewerTest::expectAgain(const View& wanted, int left) const {
  if (HasFatalFailure()) return;
  std::size_t pixels = 0;
  const bool same = eventually(
      [&] {
        pixels = differing(wanted, view(left));
        return pixels == 0;
      },
      kPatience / 4);
  EXPECT_TRUE(same) << pixels << " pixels are not what they were";
}

}  // namespace umbrage::demo_test
