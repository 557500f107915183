#pragma once

#include <QTimer>

#include <memory>
#include <string>
#include <vector>

#include "demo.hpp"
#include "window.hpp"

namespace umbrage::demo {

/// The demo's scene and the windows on it: hands keys to the one and tells the others.
class Desk {
 public:
  Desk(std::unique_ptr<Demo> demo, const Options& options);
  ~Desk();
  void show();

 private:
  [[nodiscard]] Viewer::Listener listenerOf(std::size_t window);
  bool receive(Window& window, const QKeyEvent& event);
  void press(const Key& key);
  void drawn(Window& window, double milliseconds);
  void modeChanged(Window& window);
  void tell(Window& window);
  void log(const std::string& line) const;
  void savePicture();

  Options options_;
  std::unique_ptr<Demo> demo_;
  std::vector<std::unique_ptr<Window>> windows_;
  std::string message_, pace_;
  std::size_t pictures_ = 0;
  QTimer quiet_;  ///< runs out when nothing has been drawn for a while
};

}  // namespace umbrage::demo
