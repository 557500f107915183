#include "display.hpp"

#include "umbrage/image/compare.hpp"

#include <cstdint>

namespace umbrage::demo_test {
namespace {

constexpr Milliseconds kCalm{250};

std::uint32_t word(const std::string& file, std::size_t index) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(file[4 * index + i]);
  return value;
}

// The X window dump that Xvfb keeps of its screen: a head of big-endian words, a table of colours, rows of BGRX.
image::RgbImage pictureOf(const std::string& dump) {
  constexpr std::size_t kHeadWords = 25, kColourBytes = 12;
  if (dump.size() < 4 * kHeadWords) return {};
  const auto width = static_cast<int>(word(dump, 4)), height = static_cast<int>(word(dump, 5));
  const std::size_t rowBytes = word(dump, 12), start = word(dump, 0) + kColourBytes * word(dump, 19);
  if (dump.size() < start + rowBytes * static_cast<std::size_t>(height)) return {};
  image::RgbImage picture(width, height);
  for (int y = 0; y < height; ++y) {
    const auto* row =
        reinterpret_cast<const std::uint8_t*>(dump.data()) + start + rowBytes * static_cast<std::size_t>(y);
    for (int x = 0; x < width; ++x, row += 4) picture(x, y) = {row[2], row[1], row[0]};
  }
  return picture;
}

}  // namespace

std::string Display::missing() {
  for (const char* program : {"Xvfb", "xdotool"})
    if (!isInstalled(program)) return program;
  return {};
}

std::unique_ptr<Display> Display::open() {
  std::unique_ptr<Display> display(new Display);
  const std::string screen = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
  // The server finds a free number itself and says it on the descriptor: standard output.
  display->server_ =
      std::make_unique<Process>(std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0", screen, "-fbdir",
                                                         display->folder_.text(), "-nolisten", "tcp", "-noreset"},
                                std::vector<std::string>{}, display->folder_ / "server");
  std::string number;
  const bool up = eventually([&] {
    const std::string said = display->server_->said();
    const auto end = said.rfind('\n');
    if (end == std::string::npos) return !display->server_->runs();
    const auto begin = said.find_last_not_of("0123456789", end - 1);
    number =
        said.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin + 1));
    return !number.empty() || !display->server_->runs();
  });
  if (!up || number.empty()) return nullptr;
  display->name_ = ":" + number;
  return display;
}

std::vector<std::string> Display::environment() const {
  return {"DISPLAY=" + name_,
          "QT_QPA_PLATFORM=xcb",
          "WAYLAND_DISPLAY=",
          "HOME=" + folder_.text(),
          "XDG_RUNTIME_DIR=" + folder_.text(),
          "LIBGL_ALWAYS_SOFTWARE=1"};
}

image::RgbImage Display::look() const { return pictureOf(textOf(folder_ / "Xvfb_screen0")); }

image::RgbImage Display::lookCalmly() const {
  image::RgbImage before = look();
  eventually([&] {
    std::this_thread::sleep_for(kCalm);
    image::RgbImage now = look();
    const bool calm = image::compare(before, now).pixels == 0;
    before = std::move(now);
    return calm;
  });
  return before;
}

std::string Display::act(const std::vector<std::string>& words) const {
  std::vector<std::string> all{"xdotool"};
  all.insert(all.end(), words.begin(), words.end());
  Process tool(all, environment(), folder_ / "tool");
  tool.wait();
  return tool.said();
}

}  // namespace umbrage::demo_test
