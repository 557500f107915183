#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>

namespace umbrage::io::reader {

/// How heights are found among the properties of a footprint.
struct HeightRules {
  std::optional<std::string> property;  ///< this one alone, instead of the known names
  std::optional<double> fallback;       ///< metres, where a footprint has no height and no floors
  double floorHeight = 3.0;             ///< metres
};

/// Metres above the ground.
struct BuildingHeight {
  double base = 0.0;
  double top = 0.0;
  bool fromFloors = false;
  bool fromFallback = false;
};

enum class HeightFault {
  absent,       ///< no property of a known name has a value
  notANumber,   ///< it has one, and it is no length
  notPositive,  ///< negative or zero, or no higher than its own base
  tooTall,      ///< beyond kTallest
};

/// Nothing on Earth is built higher; a number beyond it is not in metres.
inline constexpr double kTallest = 2000.0;

/// The height that a footprint's properties give. Names are compared without regard to case and to anything but letters and
/// digits: height, measuredHeight, building:height, render_height, ... in metres, or with the unit beside the number ("12 m", "40 ft");
/// then building:levels, floors, storeys, ... times the height of a floor. min_height and building:min_level lift the base.
[[nodiscard]] std::variant<BuildingHeight, HeightFault> heightOf(const nlohmann::json& properties,
                                                                 const HeightRules& rules);

}  // namespace umbrage::io::reader
