#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::study {

/// A stretch of time; `to` does not belong to it.
struct TimeSpan {
  sun::Instant from, to;
  [[nodiscard]] std::chrono::milliseconds length() const { return to - from; }
  friend bool operator==(const TimeSpan&, const TimeSpan&) = default;
};

/// Which point of the sun's disc stands for the sun.
enum class SunPoint {
  centre,
  upperLimb,  ///< kSemiDiameter above the centre: the last of the disc that sets
};

/// Half the sun's apparent diameter, in the middle of the year's 0.262 to 0.271 degrees.
inline constexpr Angle kSemiDiameter = Angle::degrees(0.267);

/// What is taken for the sun.
struct SunModel {
  sun::Refraction refraction = sun::Refraction::none;
  SunPoint point = SunPoint::centre;
  /// The sun keeps this declination, as the diagrams of some rules have it, without parallax; empty: it moves.
  std::optional<Angle> declination = {};
};

/// The sun's declination at an instant, geocentric, within 0.0005 degrees.
[[nodiscard]] Angle declinationAt(sun::Instant instant);

namespace detail {
struct SunLeg;
}

/// The sun's way over a place during a stretch of time, continuous: declination, distance and refraction move.
/// 1. Within 1e-8 radians of sun::sunPosition (0.0002 s of the sun's motion), but where the model fixes the declination.
/// 2. The sun is up where the chosen point of its disc is above the true horizon, lifted by refraction where that is asked for.
class SunCourse {
 public:
  /// REQUIRES: span.from < span.to.
  [[nodiscard]] static SunCourse make(const sun::Place& place, const TimeSpan& span, const SunModel& model = {});

  [[nodiscard]] const sun::Place& place() const { return place_; }
  [[nodiscard]] const TimeSpan& span() const { return span_; }
  [[nodiscard]] const SunModel& model() const { return model_; }
  /// When the sun is up, ascending; empty in the polar night.
  [[nodiscard]] const std::vector<TimeSpan>& up() const { return up_; }
  [[nodiscard]] std::chrono::milliseconds upTime() const;
  /// Unit vector (east, north, up) towards the chosen point of the sun.
  /// REQUIRES: within the span, or at most an hour off.
  [[nodiscard]] Vec3 towards(sun::Instant instant) const;

  /// For the other files of this room: the times when the sun is up, cut where it passes under the pole.
  [[nodiscard]] const std::vector<detail::SunLeg>& legs() const { return *legs_; }

 private:
  SunCourse() = default;
  sun::Place place_;
  TimeSpan span_{};
  SunModel model_;
  std::vector<TimeSpan> up_;
  std::vector<Vec3> samples_;  ///< geometric, of the centre, every kSampleStep from kSampleMargin before the span
  std::shared_ptr<const std::vector<detail::SunLeg>> legs_;
  [[nodiscard]] Vec3 at(double secondsFromStart) const;
  friend struct CourseMaker;
};

}  // namespace umbrage::study
