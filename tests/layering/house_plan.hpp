#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace umbrage::layering {

/// One room as CMake knows it.
struct Room {
  std::string name;
  std::string folder;              ///< below src/umbrage: "techniques/gl"
  std::set<std::string> uses;      ///< rooms it may include, itself and those that come along included
  std::set<std::string> testUses;  ///< the same for its tests
  std::set<std::string> headers;   ///< public headers, relative to the folder
};

struct HousePlan {
  std::vector<Room> rooms;
  /// The room whose folder holds `path` ("trace/occlusion.hpp"), or null.
  [[nodiscard]] const Room* roomOf(std::string_view path) const;
};

/// Reads what tests/layering/CMakeLists.txt writes: lines "room NAME FOLDER", "depends NAME ROOM..", "tests NAME ROOM..",
/// "headers NAME FILE..", rooms from the ground up.
[[nodiscard]] HousePlan readHousePlan(const std::filesystem::path& table);

/// A line that breaks a rule of the house.
struct Violation {
  std::string file;  ///< relative to the source folder
  int line = 0;
  std::string what;
};

/// The faults of one source file; `path` is relative to the root of the sources: "src/umbrage/gl/pass.cpp", "apps/cli/main.cpp".
/// 1. A room includes only rooms it depends on; nobody includes the detail/ of another room, nor goes through "..".
/// 2. Each foreign library is included in its own rooms only, and not in installed headers unless it is part of the interface.
/// 3. OpenGL functions are called in gl/ only.
/// 4. A technique includes no other technique.
[[nodiscard]] std::vector<Violation> findViolations(const HousePlan& plan, const std::string& path,
                                                    std::string_view text);

}  // namespace umbrage::layering
