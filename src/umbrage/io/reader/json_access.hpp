#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "umbrage/base/error.hpp"
#include "umbrage/math/vec.hpp"

// Reading a JSON document that may be anything: nothing here throws, whatever the value is.
namespace umbrage::io::reader {

using Json = nlohmann::json;

/// The document, or why it is none: not JSON, or nested deeper than the parser survives.
[[nodiscard]] Result<Json> parseJson(std::string_view text);

/// The member, or a null value.
inline const Json& member(const Json& object, const char* key) {
  static const Json kNull;
  if (!object.is_object()) return kNull;
  const auto found = object.find(key);
  return found == object.end() ? kNull : *found;
}
/// The element, or a null value.
inline const Json& element(const Json& array, std::size_t i) {
  static const Json kNull;
  return array.is_array() && i < array.size() ? array[i] : kNull;
}
inline std::string textOf(const Json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }
inline std::optional<double> numberOf(const Json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}
inline std::optional<std::size_t> indexOf(const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  return std::nullopt;  // the parser stores every whole number that is not negative as unsigned
}
inline std::optional<Vec3> vectorOf(const Json& value) {
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  const auto x = numberOf(value[0]), y = numberOf(value[1]), z = numberOf(value[2]);
  if (!x || !y || !z) return std::nullopt;
  return Vec3(*x, *y, *z);
}

}  // namespace umbrage::io::reader
