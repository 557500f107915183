#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace umbrage::report {

/// How far a technique's masks are from the truth's, over all lights of a picture.
struct GalleryError {
  std::string truth;          ///< the technique that it is judged by
  std::size_t differing = 0;  ///< pixels whose light differs
  std::size_t astray = 0;     ///< those that no true shadow or depth edge comes near
  std::size_t covered = 0;    ///< pixels with a surface, summed over the lights as the others are
  std::size_t unknown = 0;    ///< pixels that are not judged, since the technique knows no shadows there
  double rms = 0.0;           ///< root of the mean square difference of the light over these, 0 to 1
};

/// One technique on the scene.
struct GalleryEntry {
  std::string name, summary;
  std::vector<std::string> traits;    ///< in a word or two each: "OpenGL", "soft"
  std::string obstacle;               ///< why there is no picture of it; empty: there is one
  std::string picture, mask;          ///< files beside the page
  std::string difference;             ///< the same; empty for a truth
  std::optional<GalleryError> error;  ///< none for a truth
  double prepareMs = 0.0;             ///< once per geometry, what is made for the technique included
  double frameMs = 0.0;               ///< the median of the frames
  std::size_t frames = 1;
};

/// What the page shows.
struct Gallery {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< of scene, view and machine: what, and its value
  std::string command;                                     ///< that makes the page again
  std::vector<GalleryEntry> entries;                       ///< in the order shown; truths first
};

/// The page: a table of errors and costs that can be sorted, and every technique's picture over the truth's with a slider, its mask, and where it
/// differs. It needs no network; the pictures stand in files beside it.
[[nodiscard]] std::string galleryPage(const Gallery& gallery);

}  // namespace umbrage::report
