#include "window.hpp"

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QCoreApplication>
#include <QKeyEvent>
#include <QVBoxLayout>

#include <cmath>

namespace umbrage::demo {
namespace {

// From the front right, and a quarter turn on at each window.
SoCamera* makeCamera(int number) {
  constexpr float kDistance = 17, kHeight = 8.5f;
  const float angle = 0.35f - 0.5f * float(number);
  auto* camera = new SoPerspectiveCamera;
  camera->position.setValue(kDistance * std::sin(angle), kHeight, kDistance * std::cos(angle));
  camera->pointAt(SbVec3f(0, 2.4f, 0), SbVec3f(0, 1, 0));
  camera->focalDistance = kDistance;
  return camera;
}

QLabel* makeLine(QWidget* parent, QVBoxLayout& layout) {
  auto* line = new QLabel(parent);
  line->setTextFormat(Qt::PlainText);
  line->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // long text makes no wide window
  layout.addWidget(line);
  return line;
}

}  // namespace

Window::Window(SoSeparator* scene, int number, const Viewer::Listener& listener)
    : title_(number == 0 ? "Umbrage shadows demo" : "Umbrage shadows demo " + std::to_string(number + 1)),
      root_(hold(new SoSeparator)),
      place_(new QWidget(this)) {
  root_->addChild(makeCamera(number));
  root_->addChild(scene);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 0, 4, 4);
  layout->addWidget(place_, 1);
  state_ = makeLine(this, *layout);
  message_ = makeLine(this, *layout);
  viewer_ = std::make_unique<Viewer>(place_, listener);
  again_.setSingleShot(true);
  QObject::connect(&again_, &QTimer::timeout, [this] { viewer_->render(); });
  viewer_->setSceneGraph(root_.get());
  viewer_->saveHomePosition();
}

Window::~Window() = default;

void Window::keyPressEvent(QKeyEvent* event) {
  if (passing_) return event->ignore();  // it has come back from there
  passing_ = true;
  QCoreApplication::sendEvent(viewer_->getGLWidget(), event);
  passing_ = false;
}

bool Window::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (type == QEvent::Paint || type == QEvent::Resize || type == QEvent::Show) again_.start();
  return QWidget::eventFilter(watched, event);
}

void Window::open() {
  viewer_->show();
  viewer_->getGLWidget()->installEventFilter(this);
  show();
  viewer_->getGLWidget()->setFocus();
}

std::string Window::mode() const {
  if (viewer_->isSeekMode()) return "seek: click where to go";
  return viewer_->isViewing() ? "viewer" : "action";
}

void Window::tell(const std::string& state, const std::string& message) {
  setWindowTitle(QString::fromStdString(title_ + ": " + mode()));
  state_->setText(QString::fromStdString(state));
  message_->setText(QString::fromStdString(mode() + " mode (ESC)   " + message));
}

}  // namespace umbrage::demo
