#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::gl {

/// The name of an OpenGL object, owned. REQUIRES of every object here: its context is current when it is used and when it dies.
class Handle {
 public:
  enum class Kind { none, buffer, texture, framebuffer, vertexArray, program };
  Handle() = default;
  Handle(Kind kind, unsigned name) : kind_(kind), name_(name) {}
  Handle(Handle&& other) noexcept : kind_(other.kind_), name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle();
  [[nodiscard]] unsigned name() const { return name_; }

 private:
  Kind kind_ = Kind::none;
  unsigned name_ = 0;
};

/// Bytes on the graphics card.
class Buffer {
 public:
  Buffer();
  /// Replaces the whole contents. Errors: ErrorCode::device when memory is short.
  [[nodiscard]] Result<void> set(std::span<const std::byte> bytes);
  template <class T>
  [[nodiscard]] Result<void> setAll(const std::vector<T>& values) {
    return set(std::as_bytes(std::span(values)));
  }
  template <class T>
  [[nodiscard]] Result<void> setOne(const T& value) {
    return set(std::as_bytes(std::span(&value, 1)));
  }
  /// Makes it at least so large, for shaders to write; what it holds then means nothing. Errors: as set().
  [[nodiscard]] Result<void> reserve(std::size_t bytes);
  /// Sets all its bytes to 0.
  void clear();
  /// Copies from its beginning, waiting for shaders that write it. REQUIRES: it holds as much.
  void read(std::span<std::byte> out) const;
  template <class T>
  [[nodiscard]] std::vector<T> readAll(std::size_t count) const {
    std::vector<T> values(count);
    read(std::as_writable_bytes(std::span(values)));
    return values;
  }
  [[nodiscard]] unsigned name() const { return handle_.name(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] Result<void> allocate(std::size_t bytes, const std::byte* contents);
  Handle handle_;
  std::size_t bytes_ = 0;
};

enum class Format { grey8, rgba8, rgba16f, rg32f, rgba32f, id32, depth32f, depth32fStencil8, depth24Stencil8 };

/// A picture on the graphics card, one level, one sample.
class Texture {
 public:
  Texture() = default;
  /// Errors: ErrorCode::device when the size is beyond the driver's or memory is short.
  [[nodiscard]] static Result<Texture> make(Format format, int width, int height);
  [[nodiscard]] unsigned name() const { return handle_.name(); }
  [[nodiscard]] Format format() const { return format_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  Handle handle_;
  Format format_ = Format::grey8;
  int width_ = 0, height_ = 0;
};

/// Every driver of OpenGL 4.5 draws into so many colour pictures at once.
inline constexpr int kColourTargets = 8;

/// Colour pictures and one picture of depth, with or without a stencil (each optional), to draw into.
class Framebuffer {
 public:
  Framebuffer() = default;
  /// Errors: ErrorCode::device when the driver finds the combination incomplete. REQUIRES: the textures outlive it.
  [[nodiscard]] static Result<Framebuffer> make(const Texture* colour, const Texture* depth);
  /// Several of one size, at the locations 0, 1, ... of fragment shaders. REQUIRES: at most kColourTargets.
  [[nodiscard]] static Result<Framebuffer> make(std::span<const Texture* const> colours, const Texture* depth);
  [[nodiscard]] unsigned name() const { return handle_.name(); }

 private:
  Handle handle_;
};

/// Which buffer indices come from. Vertex shaders fetch positions themselves by gl_VertexID, so there are no attributes.
class VertexArray {
 public:
  VertexArray();
  /// 32-bit indices. REQUIRES: the buffer outlives this.
  explicit VertexArray(const Buffer& indices);
  [[nodiscard]] unsigned name() const { return handle_.name(); }

 private:
  Handle handle_;
};

}  // namespace umbrage::gl
