#include "umbrage/report/gif.hpp"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "umbrage/base/file.hpp"
#include "umbrage/report/detail/palette.hpp"

namespace umbrage::report {
namespace {

using IndexImage = image::GreyImage;

constexpr std::size_t kPaletteFrames = 8;

struct Rect {
  int left, top, width, height;
};

// The smallest rectangle that holds every change; one pixel where there is none, since a frame must have some.
Rect changed(const IndexImage& before, const IndexImage& now) {
  int left = now.width(), right = -1, top = now.height(), bottom = -1;
  for (int y = 0; y < now.height(); ++y)
    for (int x = 0; x < now.width(); ++x) {
      if (before(x, y) == now(x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  return right < 0 ? Rect{0, 0, 1, 1} : Rect{left, top, right - left + 1, bottom - top + 1};
}

struct CloseGif {
  void operator()(GifFileType* gif) const { EGifCloseFile(gif, nullptr); }
};
using Gif = std::unique_ptr<GifFileType, CloseGif>;
struct FreeMap {
  void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};

// The encoder's own files are private to their owner; written from memory they are like all others.
int append(GifFileType* gif, const GifByteType* bytes, int count) {
  auto& out = *static_cast<std::vector<std::byte>*>(gif->UserData);
  const auto added = std::as_bytes(std::span(bytes, static_cast<std::size_t>(count)));
  out.insert(out.end(), added.begin(), added.end());
  return count;
}

tl::unexpected<Error> encoderFailed(int error) {
  const char* reason = GifErrorString(error);
  return fail(ErrorCode::output, std::string("cannot be encoded: ") + (reason != nullptr ? reason : "GIF encoder"));
}

int putHeader(GifFileType& gif, const detail::Palette& palette, int width, int height) {
  std::array<GifColorType, 256> colours{};
  for (std::size_t i = 0; i < palette.colours().size(); ++i)
    colours[i] = {palette.colours()[i].r, palette.colours()[i].g, palette.colours()[i].b};
  const std::unique_ptr<ColorMapObject, FreeMap> map(GifMakeMapObject(256, colours.data()));
  if (!map || EGifPutScreenDesc(&gif, width, height, 8, 0, map.get()) != GIF_OK) return GIF_ERROR;
  // Netscape's extension: block 1, repeat count 0, that is, for ever.
  const std::array<unsigned char, 3> forEver{1, 0, 0};
  if (EGifPutExtensionLeader(&gif, APPLICATION_EXT_FUNC_CODE) != GIF_OK ||
      EGifPutExtensionBlock(&gif, 11, "NETSCAPE2.0") != GIF_OK ||
      EGifPutExtensionBlock(&gif, 3, forEver.data()) != GIF_OK)
    return GIF_ERROR;
  return EGifPutExtensionTrailer(&gif);
}

int putFrame(GifFileType& gif, const IndexImage& frame, const Rect& part, std::chrono::milliseconds delay) {
  const auto hundredths = static_cast<unsigned>(delay.count() / 10);
  // Do not dispose: the next frame is drawn over this one.
  const std::array<unsigned char, 4> control{1 << 2, static_cast<unsigned char>(hundredths & 255),
                                             static_cast<unsigned char>(hundredths >> 8 & 255), 0};
  if (EGifPutExtension(&gif, GRAPHICS_EXT_FUNC_CODE, int(control.size()), control.data()) != GIF_OK ||
      EGifPutImageDesc(&gif, part.left, part.top, part.width, part.height, false, nullptr) != GIF_OK)
    return GIF_ERROR;
  std::vector<GifPixelType> line(static_cast<std::size_t>(part.width));
  for (int y = 0; y < part.height; ++y) {
    std::copy_n(frame.row(part.top + y) + part.left, part.width, line.begin());
    if (EGifPutLine(&gif, line.data(), part.width) != GIF_OK) return GIF_ERROR;
  }
  return GIF_OK;
}

int putComments(GifFileType& gif, const std::vector<std::string>& comments) {
  for (const std::string& comment : comments)
    if (EGifPutComment(&gif, comment.substr(0, 255).c_str()) != GIF_OK) return GIF_ERROR;
  return GIF_OK;
}

Result<detail::Palette> paletteOf(const Animation& animation) {
  detail::ColourCount count;
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < kPaletteFrames; ++i) chosen.insert(i * (animation.frames - 1) / (kPaletteFrames - 1));
  for (const std::size_t i : chosen) {
    const auto picture = animation.frame(i);
    if (!picture) return tl::unexpected(picture.error());
    count.add(*picture);
  }
  return detail::Palette(count);
}

Result<std::vector<std::byte>> encode(const Animation& animation, const detail::Palette& palette) {
  std::vector<std::byte> bytes;
  int error = 0;
  Gif gif(EGifOpen(&bytes, append, &error));
  if (!gif) return encoderFailed(error);
  EGifSetGifVersion(gif.get(), true);
  IndexImage before;
  for (std::size_t i = 0; i < animation.frames; ++i) {
    const auto picture = animation.frame(i);
    if (!picture) return tl::unexpected(picture.error());
    IndexImage frame = palette.indices(*picture);
    const bool first = i == 0;
    if (first && putHeader(*gif, palette, frame.width(), frame.height()) != GIF_OK) return encoderFailed(gif->Error);
    if (first && putComments(*gif, animation.comments) != GIF_OK) return encoderFailed(gif->Error);
    const Rect part = first ? Rect{0, 0, frame.width(), frame.height()} : changed(before, frame);
    if (putFrame(*gif, frame, part, animation.delay) != GIF_OK) return encoderFailed(gif->Error);
    before = std::move(frame);
  }
  if (EGifCloseFile(gif.release(), &error) != GIF_OK) return encoderFailed(error);
  return bytes;
}

}  // namespace

Result<void> writeGif(const std::filesystem::path& path, const Animation& animation) {
  UMBRAGE_CHECK(animation.frames > 0, "an animation has frames");
  const auto palette = paletteOf(animation);
  if (!palette) return tl::unexpected(palette.error());
  const auto bytes = encode(animation, *palette);
  if (!bytes) return tl::unexpected(bytes.error());
  return writeFile(path, *bytes);
}

}  // namespace umbrage::report
