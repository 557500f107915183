#pragma once

#include <Inventor/Qt/viewers/SoQtExaminerViewer.h>

#include <functional>

class QKeyEvent;

namespace umbrage::demo {

/// An examiner viewer that tells what happens to it.
class Viewer : public SoQtExaminerViewer {
 public:
  struct Listener {
    std::function<bool(const QKeyEvent&)> key;         ///< before the viewer sees it; true: taken
    std::function<void(double milliseconds)> picture;  ///< one has been drawn
    std::function<void()> mode;                        ///< viewer or action, or seeking, has changed
  };
  Viewer(QWidget* parent, Listener listener);

  void setViewing(SbBool on) override;
  using SoQtExaminerViewer::isSeekMode;

 protected:
  void redraw() override;
  void actualRedraw() override;
  void setSeekMode(SbBool on) override;

 private:
  static SbBool receive(void* self, QEvent* event);
  Listener listener_;
  bool drawn_ = false;  ///< by this redraw: SoQt leaves it when the window is not there yet
};

}  // namespace umbrage::demo
