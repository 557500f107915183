#pragma once

#include <cairo.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::report::detail {

struct TextStyle {
  double size = 12.0;  ///< pixels
  bool bold = false;
  image::Rgb8 colour{40, 44, 52};
};

enum class Align { left, centre, right };

/// A picture to draw on, in pixels from the top left. Text falls back to the drawing library's built-in letters where the machine
/// has no fonts; letters are not hinted, so that pictures do not depend on a machine's settings.
class Canvas {
 public:
  Canvas(int width, int height, image::Rgb8 background);

  [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
  [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }

  void paste(const image::RgbImage& picture, int left, int top);
  void fillRect(double x, double y, double w, double h, image::Rgb8 colour, double alpha = 1.0, double radius = 0.0);
  void strokeRect(double x, double y, double w, double h, image::Rgb8 colour, double lineWidth);
  void fillPolygon(std::span<const Vec2> points, image::Rgb8 colour, double alpha = 1.0);
  void strokeLine(std::span<const Vec2> points, image::Rgb8 colour, double lineWidth, double alpha = 1.0);
  void fillDisc(const Vec2& centre, double radius, image::Rgb8 colour, double alpha = 1.0);

  /// Draws on the baseline y; returns the width. UTF-8; what is not printable becomes '?'.
  double text(double x, double y, std::string_view text, const TextStyle& style, Align align = Align::left);
  [[nodiscard]] double textWidth(std::string_view text, const TextStyle& style) const;
  /// Lines no wider than `width`, of whole words where they fit.
  [[nodiscard]] std::vector<std::string> wrap(std::string_view text, double width, const TextStyle& style) const;

  [[nodiscard]] image::RgbImage picture() const;

 private:
  void breakWord(std::string& word, double width, const TextStyle& style, std::vector<std::string>& lines) const;
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  void use(image::Rgb8 colour, double alpha) const;
  void use(const TextStyle& style) const;
  void trace(std::span<const Vec2> points) const;
  [[nodiscard]] std::string drawable(std::string_view text) const;

  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

}  // namespace umbrage::report::detail
