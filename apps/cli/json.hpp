#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "umbrage/math/box.hpp"

namespace umbrage::cli {

/// Keys stay in the order in which they are set, so files read well and never change by chance.
using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json toJson(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

/// Indented text with a final newline, lists of numbers in one line; bytes that are no UTF-8 (from a hostile file) are replaced.
[[nodiscard]] std::string jsonText(const Json& json);

}  // namespace umbrage::cli
