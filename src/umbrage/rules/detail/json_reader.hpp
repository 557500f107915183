#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::rules::detail {

/// Reads the members of one JSON object and remembers the first fault, so that a whole object is read before anybody asks.
/// 1. Members that nobody asked for are a fault (finish).
class JsonReader {
 public:
  using Json = nlohmann::json;
  /// `path` names the object in messages: "requirements[0].window". `fault` is shared by all readers of a document.
  JsonReader(const Json& object, std::string path, std::string& fault);

  [[nodiscard]] bool has(const char* key);
  [[nodiscard]] std::string text(const char* key, bool wanted = false);
  [[nodiscard]] std::optional<double> number(const char* key, double least, double most);
  [[nodiscard]] std::optional<int> whole(const char* key, int least, int most);
  [[nodiscard]] bool flag(const char* key);
  [[nodiscard]] std::vector<std::string> texts(const char* key);
  [[nodiscard]] std::vector<double> numbers(const char* key, double least, double most);
  /// The array of objects, or the one object; empty where absent.
  [[nodiscard]] std::vector<JsonReader> objects(const char* key);
  [[nodiscard]] std::optional<JsonReader> object(const char* key);
  /// One of the words, by its place; 0 where absent.
  [[nodiscard]] std::size_t word(const char* key, const std::vector<std::string_view>& words);

  void wrong(const std::string& key, const std::string& what);
  void finish();
  [[nodiscard]] const Json& json() const { return *object_; }

 private:
  [[nodiscard]] const Json* find(const char* key);
  const Json* object_;
  std::string path_;
  std::string* fault_;
  std::vector<std::string> asked_;
};

/// The document, or why it is none. Of members of one name the last one counts.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text, const std::string& where);

/// The document, or why it is none, with the member at which it ceases to be one.
/// 1. Two members of one name in an object, and numbers that no double holds, are errors.
[[nodiscard]] Result<nlohmann::json> parseStrictJson(std::string_view text, const std::string& where);

}  // namespace umbrage::rules::detail
