#include "umbrage/report/write_profile.hpp"

#include <algorithm>

#include "umbrage/base/file.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/report/detail/remarks.hpp"
#include "umbrage/report/gif.hpp"
#include "umbrage/report/profile_pictures.hpp"
#include "umbrage/report/step_pictures.hpp"

namespace umbrage::report {
namespace {

// A day's animation lasts about this long; few steps stay longer each, many pass faster.
constexpr std::chrono::milliseconds kLoop{7000}, kShortest{60}, kLongest{700};

std::filesystem::path beside(const std::filesystem::path& path, const std::string& ending) {
  return path.parent_path() / (path.stem().string() + ending);
}

}  // namespace

Result<std::vector<std::filesystem::path>> writeProfile(const study::Profile& profile, const scene::Scene& scene,
                                                        const std::filesystem::path& path,
                                                        const ProgressSink& progress) {
  if (lowerExtension(path) != ".png") return fail(ErrorCode::usage, "a profile is written as .png", path.string());
  const auto hours = beside(path, "-hours.png"), animation = beside(path, ".gif");

  const StepPictures pictures(scene, profile);
  std::size_t made = 0;
  Animation steps;
  steps.frames = profile.steps.size();
  steps.delay = std::clamp(kLoop / int(profile.steps.size()), kShortest, kLongest);
  for (const study::LedgerLine& line : profile.ledger) steps.comments.push_back(line.subject + ": " + line.text);
  steps.frame = [&](std::size_t i) -> Result<image::RgbImage> {
    const double total = double(steps.frames) + double(std::min<std::size_t>(steps.frames, 8)) + 2.0;
    if (!reportProgress(progress, std::min(1.0, double(made++) / total), "drawing"))
      return fail(ErrorCode::cancelled, "cancelled");
    return pictures.picture(i);
  };
  if (auto done = writeGif(animation, steps); !done) return tl::unexpected(done.error());
  const auto remarks = detail::remarksOf(profile.ledger);
  if (auto done = png::write(hours, hoursPicture(scene, profile), remarks); !done) return tl::unexpected(done.error());
  if (auto done = png::write(path, shadowPicture(scene, profile), remarks); !done) return tl::unexpected(done.error());
  static_cast<void>(reportProgress(progress, 1.0, "drawing"));
  return std::vector{path, hours, animation};
}

}  // namespace umbrage::report
