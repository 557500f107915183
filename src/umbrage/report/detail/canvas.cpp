#include "umbrage/report/detail/canvas.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace umbrage::report::detail {
namespace {

constexpr const char* kFont = "DejaVu Sans";

std::uint32_t packed(image::Rgb8 c) { return std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b; }

// Bytes of the UTF-8 character that starts here; 0 where none does. Names from files may hold anything, and one bad byte would put
// the drawing library into its error state, in which it draws nothing more.
std::size_t characterLength(std::string_view s) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || length > s.size()) return 0;
  std::uint32_t code = length == 1 ? first : first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= kSmallest[length] && code < 0x110000 && code >= 0x20 && code != 0x7F && !surrogate ? length : 0;
}

// The text with '?' for every byte that is no printable character.
std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = characterLength(text);
    out += length > 0 ? text.substr(0, length) : std::string_view("?");
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

// The built-in letters know ASCII alone.
std::string withoutDegreeSigns(std::string text) {
  constexpr std::string_view kSign = "\u00b0";
  for (std::size_t at = text.find(kSign); at != std::string::npos; at = text.find(kSign))
    text.replace(at, kSign.size(), " deg");
  return text;
}

}  // namespace

Canvas::Canvas(int width, int height, image::Rgb8 background)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), context_(cairo_create(surface_.get())) {
  UMBRAGE_CHECK(cairo_status(context_.get()) == CAIRO_STATUS_SUCCESS, "a canvas of this size");
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
  fillRect(0, 0, width, height, background);
}

void Canvas::paste(const image::RgbImage& picture, int left, int top) {
  cairo_surface_flush(surface_.get());
  unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  for (int y = 0; y < picture.height() && top + y < height(); ++y)
    for (int x = 0; x < picture.width() && left + x < width(); ++x) {
      const std::uint32_t pixel = packed(picture(x, y));
      std::memcpy(data + std::ptrdiff_t(top + y) * stride + std::ptrdiff_t(left + x) * 4, &pixel, sizeof pixel);
    }
  cairo_surface_mark_dirty(surface_.get());
}

void Canvas::use(image::Rgb8 c, double alpha) const {
  cairo_set_source_rgba(context_.get(), c.r / 255.0, c.g / 255.0, c.b / 255.0, alpha);
}

void Canvas::use(const TextStyle& style) const {
  cairo_select_font_face(context_.get(), kFont, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size);
}

void Canvas::trace(std::span<const Vec2> points) const {
  cairo_new_path(context_.get());
  for (const Vec2& p : points) cairo_line_to(context_.get(), p.x, p.y);
}

void Canvas::fillRect(double x, double y, double w, double h, image::Rgb8 colour, double alpha, double radius) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  use(colour, alpha);
  cairo_new_path(context_.get());
  if (radius <= 0.0) {
    cairo_rectangle(context_.get(), x, y, w, h);
  } else {
    cairo_arc(context_.get(), x + w - radius, y + radius, radius, -kQuarter, 0.0);
    cairo_arc(context_.get(), x + w - radius, y + h - radius, radius, 0.0, kQuarter);
    cairo_arc(context_.get(), x + radius, y + h - radius, radius, kQuarter, 2.0 * kQuarter);
    cairo_arc(context_.get(), x + radius, y + radius, radius, 2.0 * kQuarter, 3.0 * kQuarter);
    cairo_close_path(context_.get());
  }
  cairo_fill(context_.get());
}

void Canvas::strokeRect(double x, double y, double w, double h, image::Rgb8 colour, double lineWidth) {
  use(colour, 1.0);
  cairo_new_path(context_.get());
  cairo_set_line_width(context_.get(), lineWidth);
  cairo_rectangle(context_.get(), x, y, w, h);
  cairo_stroke(context_.get());
}

void Canvas::fillPolygon(std::span<const Vec2> points, image::Rgb8 colour, double alpha) {
  use(colour, alpha);
  trace(points);
  cairo_fill(context_.get());
}

void Canvas::strokeLine(std::span<const Vec2> points, image::Rgb8 colour, double lineWidth, double alpha) {
  use(colour, alpha);
  trace(points);
  cairo_set_line_width(context_.get(), lineWidth);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context_.get());
}

void Canvas::fillDisc(const Vec2& centre, double radius, image::Rgb8 colour, double alpha) {
  use(colour, alpha);
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(context_.get());
}

std::string Canvas::drawable(std::string_view text) const {
  const bool builtIn = cairo_scaled_font_get_type(cairo_get_scaled_font(context_.get())) == CAIRO_FONT_TYPE_USER;
  return builtIn ? withoutDegreeSigns(printable(text)) : printable(text);
}

double Canvas::textWidth(std::string_view text, const TextStyle& style) const {
  use(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), drawable(text).c_str(), &extents);
  return extents.x_advance;
}

double Canvas::text(double x, double y, std::string_view text, const TextStyle& style, Align align) {
  const double width = textWidth(text, style);
  use(style.colour, 1.0);
  cairo_move_to(context_.get(), x - (align == Align::right ? width : align == Align::centre ? 0.5 * width : 0.0), y);
  cairo_show_text(context_.get(), drawable(text).c_str());
  return width;
}

// A word too long for a line, such as a hash, is broken where the line ends; characters stay whole.
void Canvas::breakWord(std::string& word, double width, const TextStyle& style, std::vector<std::string>& lines) const {
  while (textWidth(word, style) > width) {
    std::size_t fits = 0, next = 0;
    do {
      fits = next;
      next += std::max<std::size_t>(1, characterLength(std::string_view(word).substr(next)));
    } while (next < word.size() && textWidth(std::string_view(word).substr(0, next), style) <= width);
    if (fits == 0) fits = next;
    if (fits >= word.size()) return;
    lines.push_back(word.substr(0, fits));
    word.erase(0, fits);
  }
}

std::vector<std::string> Canvas::wrap(std::string_view text, double width, const TextStyle& style) const {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word(text.substr(begin, end - begin));
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && textWidth(longer, style) > width) {
      lines.push_back(std::move(line));
      line = word;
    } else {
      line = longer;
    }
    breakWord(line, width, style, lines);
    begin = end + 1;
  }
  lines.push_back(std::move(line));
  return lines;
}

image::RgbImage Canvas::picture() const {
  cairo_surface_flush(surface_.get());
  const unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  image::RgbImage out(width(), height());
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, data + std::ptrdiff_t(y) * stride + std::ptrdiff_t(x) * 4, sizeof pixel);
      out(x, y) = {static_cast<std::uint8_t>(pixel >> 16), static_cast<std::uint8_t>(pixel >> 8),
                   static_cast<std::uint8_t>(pixel)};
    }
  return out;
}

}  // namespace umbrage::report::detail
