#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "umbrage/base/check.hpp"

namespace umbrage::image {

/// Makes values without setting them where their type lets it: large pictures that are painted all over by many threads are not filled by one before.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class First, class... Rest>
  void construct(U* at, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(at)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};
/// A vector whose new values mean nothing.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// A dense picture of `T`, row by row from the top left.
template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, const T& fill = T{})
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {
    UMBRAGE_CHECK(width >= 0 && height >= 0, "image size");
  }

  /// For who sets every pixel: what they hold before means nothing.
  [[nodiscard]] static Image unset(int width, int height) {
    UMBRAGE_CHECK(width >= 0 && height >= 0, "image size");
    Image image;
    image.width_ = width, image.height_ = height;
    image.pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return image;
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool empty() const { return pixels_.empty(); }
  [[nodiscard]] std::size_t size() const { return pixels_.size(); }
  [[nodiscard]] std::span<T> pixels() { return pixels_; }
  [[nodiscard]] std::span<const T> pixels() const { return pixels_; }
  [[nodiscard]] T* row(int y) {
    return pixels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
  }
  [[nodiscard]] const T* row(int y) const {
    return pixels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
  }
  [[nodiscard]] T& operator()(int x, int y) { return row(y)[x]; }
  [[nodiscard]] const T& operator()(int x, int y) const { return row(y)[x]; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  friend bool operator==(const Image&, const Image&) = default;

 private:
  int width_ = 0;
  int height_ = 0;
  UnsetVector<T> pixels_;
};

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

using GreyImage = Image<std::uint8_t>;
using RgbImage = Image<Rgb8>;
using RgbaImage = Image<Rgba8>;

}  // namespace umbrage::image
