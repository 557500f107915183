#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stage.hpp"

namespace umbrage::peers {

/// How Ogre is to draw: nothing here changes where shadows fall.
struct Settings {
  std::string system = "RenderSystem_GL";
  bool additive = true;  ///< SHADOWTYPE_STENCIL_ADDITIVE; false: SHADOWTYPE_STENCIL_MODULATIVE
  bool shadows = true;
  bool infinite = false;    ///< volumes reach to infinity; false: to the scene's farthest corner from the light
  double tile = 0.0;        ///< casters are merged by squares of this side; 0: one entity a mesh
  std::size_t indices = 0;  ///< size of Ogre's buffer for indices of volumes; 0: as Ogre has it (51,200)
  int width = 1280, height = 720;
};

/// One shot of a scene in a window of Ogre's, drawn again and again.
class Picture {
 public:
  Picture(const Stage& stage, const StageShot& shot, const Settings& settings);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Draws a frame with the light moved by `shift` along x, waits until it is finished (a pixel is read), and returns what that took
  /// in milliseconds. The window's buffers are not swapped: showing the picture is not what is measured.
  [[nodiscard]] double frame(double shift);
  /// The last frame, RGB rows from the top.
  [[nodiscard]] std::vector<std::uint8_t> pixels() const;
  [[nodiscard]] std::size_t entities() const;
  [[nodiscard]] std::size_t batches() const;  ///< draw calls of the last frame

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbrage::peers
