#include <Inventor/Qt/SoQt.h>
#include <fmt/format.h>
#include <QApplication>

#include <cstdlib>
#include <string>
#include <vector>

#include "desk.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"

namespace umbrage::demo {
namespace {

int fail(const Error& error) {
  fmt::print(stderr, "error: {}\n", error.text());
  return exitCode(error.code);
}

int run(const Options& options, char* program) {
  // Qt ends the program where there is no display; SoQt and Coin draw through GLX, so X it is also under Wayland.
  if (std::getenv("DISPLAY") == nullptr && std::getenv("QT_QPA_PLATFORM") == nullptr)
    return fail({ErrorCode::device, "there is no X display for a window (DISPLAY is not set)", {}});
  ::setenv("QT_QPA_PLATFORM", "xcb", 0);
  int count = 1;
  char* words[] = {program, nullptr};
  QApplication application(count, words);
  QWidget anchor;  // SoQt wants one widget to hang on
  SoQt::init(&anchor);
  coin::init();
  auto demo = Demo::make(options);
  if (!demo) return fail(demo.error());
  Desk desk(std::move(*demo), options);
  desk.show();
  return QApplication::exec();
}

}  // namespace
}  // namespace umbrage::demo

int main(int count, char** words) {
  using namespace umbrage;
  const auto request = demo::parse(std::vector<std::string>(words + 1, words + count));
  if (!request.options) return request.exitCode;
  return demo::run(*request.options, words[0]);
}
