#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/base/progress.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/sun_course.hpp"

namespace umbrage::study {

/// A point that may be lit, and the way it faces, in the scene's coordinates. normal: of any length; (0,0,0) faces all ways.
struct Receiver {
  Vec3 position{0.0};
  Vec3 normal{0.0};
};

/// When receivers are lit: for each any number of stretches, ascending, apart from each other.
class SunHours {
 public:
  SunHours() = default;
  SunHours(std::vector<std::size_t> begin, std::vector<TimeSpan> lit)
      : begin_(std::move(begin)), lit_(std::move(lit)) {}

  [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  [[nodiscard]] std::span<const TimeSpan> lit(std::size_t receiver) const {
    return std::span(lit_).subspan(begin_[receiver], begin_[receiver + 1] - begin_[receiver]);
  }
  [[nodiscard]] std::chrono::milliseconds total(std::size_t receiver) const;
  [[nodiscard]] std::chrono::milliseconds longest(std::size_t receiver) const;
  /// Of the stretches that last at least `least`: how many, and how long together.
  struct Runs {
    std::size_t count = 0;
    std::chrono::milliseconds total{0};
  };
  [[nodiscard]] Runs runs(std::size_t receiver, std::chrono::milliseconds least) const;

 private:
  std::vector<std::size_t> begin_;  ///< one more than receivers
  std::vector<TimeSpan> lit_;
};

struct ExactHoursOptions {
  /// How many threads work; 0: as many as the machine has.
  unsigned threads = 0;
  /// Eight lanes of AVX2 where the processor has them; without, the same in plain C++, several times slower.
  bool wide = true;
  /// Materials less opaque than this cast nothing; 0: all cast.
  double leastOpacity = 0.0;
};

/// Exact times of sun: not sampled, but solved for the moments at which an edge of the scene uncovers or covers the sun.
/// Built once for a scene at a place, const afterwards; any threads may ask at once.
/// 1. Any triangles cast, closed or not, from both sides; instances that do not cast are ignored.
/// 2. Moments are those of exact arithmetic on scene::flatten's triangles and the course's sun, mostly within 0.1 s and, of
///    275,000 points held against all triangles in double precision, all within 1 s (scripts/sweep hours).
/// 3. Lit or dark stretches shorter than 0.1 s may be left out.
/// 4. A receiver lies on the side of a surface that its normal points to, where it touches it (nearer than kContact of the
///    scene's largest coordinate): a wall's own triangles do not hide the sun from it while the sun is before the wall, and a
///    slope does while the sun is behind the slope, whatever the normal says. Where the normal runs along the surface or is 0, it lies outside of a
///    closed solid. On an edge or a corner each face hides what lies behind it on its own side.
/// 5. A receiver is dark while the sun is behind its own plane, and within a closed solid.
/// 6. The same receivers get the same times whatever their order, apart from 2, and whatever the number of threads.
class ExactHours {
 public:
  /// Errors: none but memory; a scene without casters is no error.
  [[nodiscard]] static Result<ExactHours> build(const scene::Scene& scene, const sun::Place& place,
                                                const ExactHoursOptions& options = {});
  ExactHours(ExactHours&&) noexcept;
  ExactHours& operator=(ExactHours&&) noexcept;
  ~ExactHours();

  /// When each of the receivers is lit. REQUIRES: a course over the place this was built for. Errors: cancelled.
  [[nodiscard]] Result<SunHours> at(std::span<const Receiver> receivers, const SunCourse& course,
                                    const ProgressSink& progress = {}) const;

  struct Impl;

 private:
  explicit ExactHours(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// Of the scene's largest coordinate: how near a receiver must be to a surface to lie on it.
inline constexpr double kContact = 0x1p-21;

}  // namespace umbrage::study
