#include "desk.hpp"

#include <Inventor/nodes/SoSeparator.h>
#include <fmt/format.h>
#include <QApplication>
#include <QKeyEvent>
#include <QScreen>

#include <algorithm>
#include <cstdio>

namespace umbrage::demo {
namespace {

constexpr int kQuietMilliseconds = 500;
constexpr int kSmallFile = 0;  // Qt's scale for PNG: compressed most

}  // namespace

Desk::Desk(std::unique_ptr<Demo> demo, const Options& options) : options_(options), demo_(std::move(demo)) {
  message_ = "S, then a click, goes there; shadows_demo -h lists the keys";
  for (std::size_t i = 0; i < static_cast<std::size_t>(options.windows); ++i) {
    windows_.push_back(std::make_unique<Window>(demo_->scene(), static_cast<int>(i), listenerOf(i)));
    windows_.back()->resize(options.width, options.height);
  }
  quiet_.setSingleShot(true);
  quiet_.setInterval(kQuietMilliseconds);
  QObject::connect(&quiet_, &QTimer::timeout, [this] { savePicture(); });
}

Desk::~Desk() = default;

void Desk::show() {
  for (const Key* key : options_.keys) press(*key);
  for (const auto& window : windows_) {
    tell(*window);
    window->open();
  }
}

Viewer::Listener Desk::listenerOf(std::size_t window) {
  return {[this, window](const QKeyEvent& event) { return receive(*windows_[window], event); },
          [this, window](double milliseconds) { drawn(*windows_[window], milliseconds); },
          // The viewer's own setting up comes before it is in the list.
          [this, window] { window < windows_.size() ? modeChanged(*windows_[window]) : void(); }};
}

bool Desk::receive(Window& window, const QKeyEvent& event) {
  const Key* key = keyOf(event.key());
  if (key == nullptr || (key->actionOnly && window.viewer().isViewing())) return false;
  if (key->repeats || !event.isAutoRepeat()) press(*key);
  return true;
}

void Desk::press(const Key& key) {
  const Said said = key.press(*demo_);
  message_ = fmt::format("{}: {}", key.name, said ? *said : "error: " + said.error().text());
  log("key " + message_);
  for (const auto& each : windows_) tell(*each);
}

void Desk::drawn(Window& window, double milliseconds) {
  pace_ = fmt::format("{:.1f} fps ({:.0f} ms) | ", 1000.0 / std::max(milliseconds, 0.001), milliseconds);
  ++pictures_;
  if (options_.verbose) log(fmt::format("picture {}: {:.1f} ms, {}", pictures_, milliseconds, demo_->work()));
  tell(window);
  if (!options_.picture.empty()) quiet_.start();
}

void Desk::modeChanged(Window& window) {
  log("mode: " + window.mode());
  tell(window);
}

void Desk::tell(Window& window) {
  const std::string problem = demo_->problem();
  window.tell(pace_ + demo_->state(), problem.empty() ? message_ : problem);
}

void Desk::log(const std::string& line) const {
  if (options_.verbose) fmt::print(stderr, "{}\n", line);
}

void Desk::savePicture() {
  Window& window = *windows_.front();
  const QPixmap picture = window.screen()->grabWindow(window.winId());
  const bool saved = picture.save(QString::fromStdString(options_.picture.string()), "PNG", kSmallFile);
  if (!saved) fmt::print(stderr, "error: {}: cannot be written\n", options_.picture.string());
  QApplication::exit(saved ? 0 : exitCode(ErrorCode::output));
}

}  // namespace umbrage::demo
