#include "viewer.hpp"

#include <QKeyEvent>

#include <chrono>
#include <utility>

namespace umbrage::demo {

Viewer::Viewer(QWidget* parent, Listener listener)
    : SoQtExaminerViewer(parent, nullptr, TRUE), listener_(std::move(listener)) {
  setStencilBuffer(TRUE);
  setHeadlight(FALSE);  // it would shine into every shadow
  setSeekTime(0.5f);
  setBackgroundColor(SbColor(0.22f, 0.26f, 0.32f));
  setEventCallback(receive, this);
}

void Viewer::setViewing(SbBool on) {
  SoQtExaminerViewer::setViewing(on);
  if (listener_.mode) listener_.mode();
}

void Viewer::setSeekMode(SbBool on) {
  SoQtExaminerViewer::setSeekMode(on);
  if (listener_.mode) listener_.mode();
}

void Viewer::redraw() {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  drawn_ = false;
  SoQtExaminerViewer::redraw();
  if (drawn_ && listener_.picture)
    listener_.picture(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
}

void Viewer::actualRedraw() {
  SoQtExaminerViewer::actualRedraw();
  drawn_ = true;
}

SbBool Viewer::receive(void* self, QEvent* event) {
  auto& viewer = *static_cast<Viewer*>(self);
  if (event->type() != QEvent::KeyPress) return FALSE;
  return viewer.listener_.key(*static_cast<QKeyEvent*>(event)) ? TRUE : FALSE;
}

}  // namespace umbrage::demo
