#include "report/pictures.hpp"

#include <fstream>
#include <optional>

#include "umbrage/png/png.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::benchmarks {
namespace {

std::optional<image::RgbImage> readPpm(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string kind;
  int width = 0, height = 0, most = 0;
  if (!(in >> kind >> width >> height >> most) || kind != "P6" || most != 255) return std::nullopt;
  in.get();
  image::RgbImage picture(width, height);
  const auto next = [&] { return static_cast<std::uint8_t>(in.get()); };
  for (auto& pixel : picture.pixels()) pixel.r = next(), pixel.g = next(), pixel.b = next();
  return in ? std::optional(std::move(picture)) : std::nullopt;
}

std::optional<image::RgbImage> readPng(const std::filesystem::path& path) {
  const auto read = png::read(path);
  if (!read) return std::nullopt;
  image::RgbImage picture(read->width(), read->height());
  for (std::size_t i = 0; i < read->size(); ++i) {
    const image::Rgba8 p = read->pixels()[i];
    picture.pixels()[i] = {p.r, p.g, p.b};
  }
  return picture;
}

std::optional<image::RgbImage> half(const std::filesystem::path& path) {
  const auto whole = path.extension() == ".ppm" ? readPpm(path) : readPng(path);
  if (!whole) return std::nullopt;
  return shadow::averaged(*whole, 2);
}

void paste(image::RgbImage& onto, const image::RgbImage& picture, int left, int top) {
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) onto(left + x, top + y) = picture(x, y);
}

}  // namespace

Result<bool> writeSideBySide(const std::vector<std::pair<std::filesystem::path, std::filesystem::path>>& pairs,
                             const std::filesystem::path& path) {
  std::vector<std::pair<image::RgbImage, image::RgbImage>> found;
  for (const auto& [left, right] : pairs) {
    auto one = half(left), other = half(right);
    if (one && other) found.emplace_back(std::move(*one), std::move(*other));
  }
  if (found.empty()) return false;
  constexpr int kGap = 8;
  const int width = found[0].first.width(), height = found[0].first.height();
  image::RgbImage sheet(2 * width + kGap, static_cast<int>(found.size()) * (height + kGap) - kGap, {255, 255, 255});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const int top = static_cast<int>(i) * (height + kGap);
    paste(sheet, found[i].first, 0, top);
    paste(sheet, found[i].second, width + kGap, top);
  }
  if (auto done = png::write(path, sheet); !done) return tl::unexpected(done.error());
  return true;
}

}  // namespace umbrage::benchmarks
