#pragma once

#include <Inventor/nodes/SoSeparator.h>
#include <QLabel>
#include <QWidget>

#include <functional>
#include <string>

#include "ref.hpp"
#include "viewer.hpp"

namespace umbrage::demo {

/// A window: a viewer, and below it two lines of text.
class Window : public QWidget {
 public:
  /// `number` from 0; each sees the scene from another side.
  Window(SoSeparator* scene, int number, const Viewer::Listener& listener);
  ~Window() override;

  [[nodiscard]] Viewer& viewer() { return *viewer_; }
  [[nodiscard]] std::string mode() const;
  void tell(const std::string& state, const std::string& message);

 private:
  std::string title_;
  Ref<SoSeparator> root_;
  QWidget* place_;
  QLabel *state_, *message_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace umbrage::demo
