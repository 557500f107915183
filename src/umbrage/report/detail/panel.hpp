#pragma once

#include <functional>
#include <string>
#include <vector>

#include "umbrage/report/detail/canvas.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report::detail {

/// The column beside a view, written from the top down. Sizes are for a view 720 pixels high and grow with it.
class Panel {
 public:
  Panel(Canvas& canvas, double left, double width, double scale);

  [[nodiscard]] double bottom() const { return y_; }

  void title(const std::string& title, const std::string& subtitle);
  void heading(const std::string& text);
  void gap(double pixels) { y_ += pixels * scale_; }
  void paragraph(const std::string& text);
  /// A bar of equal cells, coloured by `colour` of the cell's number, with labels under the cells named.
  struct Tick {
    double at;  ///< 0..1 along the bar
    std::string label;
  };
  void bar(std::size_t cells, const std::function<image::Rgb8(std::size_t)>& colour, const std::vector<Tick>& ticks);
  /// One row: swatches, then columns of text from the left and one at the right.
  void row(const std::vector<image::Rgb8>& swatches, const std::string& text, const std::string& right);
  void ledger(const std::vector<study::LedgerLine>& lines);

  /// Rows of legend that fit above `bottom`, a ledger below them included.
  [[nodiscard]] double rowHeight() const { return 19.0 * scale_; }

 private:
  Canvas& canvas_;
  double left_, width_, scale_, y_;
};

/// The directions of the view and the way of the sun, as a small dome over a compass, centred at `centre`.
/// `colours`: one per step of the profile.
void drawSunDome(Canvas& canvas, const scene::Scene& scene, const study::Profile& profile,
                 const std::vector<image::Rgb8>& colours, const Vec2& centre, double radius);

/// Composes a view and its panel: the view keeps its pixels at the top left, the panel stands to its right, and the whole is as
/// high as the higher of both. `draw` is called twice, the first time to measure.
[[nodiscard]] image::RgbImage besidePanel(const image::RgbImage& view, const std::function<void(Panel&)>& write,
                                          const std::function<void(Canvas&, double scale)>& overView);

}  // namespace umbrage::report::detail
