#pragma once

#include <Inventor/nodes/SoSeparator.h>
#include <QLabel>
#include <QTimer>
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
  /// Shows the window, with the keys in the viewer.
  void open();
  void tell(const std::string& state, const std::string& message);

 protected:
  /// Keys are the viewer's wherever in the window the mouse is.
  void keyPressEvent(QKeyEvent* event) override;
  /// SoQt does not draw again by itself what the window system has resized or thrown away.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool passing_ = false;  ///< a key that the viewer has had already
  QTimer again_;          ///< draws once all that has happened is known
  std::string title_;
  Ref<SoSeparator> root_;
  QWidget* place_;
  QLabel *state_, *message_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace umbrage::demo
