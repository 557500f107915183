#include "umbrage/rules/detail/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace umbrage::rules::detail {
namespace {

constexpr int kDeepest = 64;  // no rule and no map of areas is nested deeper

}  // namespace

JsonReader::JsonReader(const Json& object, std::string path, std::string& fault)
    : object_(&object), path_(std::move(path)), fault_(&fault) {
  if (!object.is_object()) wrong("", "an object {..} is wanted");
}

void JsonReader::wrong(const std::string& key, const std::string& what) {
  if (!fault_->empty()) return;
  const std::string place = path_.empty() ? key : key.empty() ? path_ : path_ + "." + key;
  *fault_ = place.empty() ? what : place + ": " + what;
}

const JsonReader::Json* JsonReader::find(const char* key) {
  asked_.emplace_back(key);
  if (!object_->is_object()) return nullptr;
  const auto found = object_->find(key);
  return found == object_->end() ? nullptr : &*found;
}

bool JsonReader::has(const char* key) { return object_->is_object() && object_->contains(key); }

std::string JsonReader::text(const char* key, bool wanted) {
  const Json* value = find(key);
  if (value == nullptr) {
    if (wanted) wrong(key, "is missing");
    return {};
  }
  if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
    wrong(key, "a text is wanted");
    return {};
  }
  return value->get<std::string>();
}

std::optional<double> JsonReader::number(const char* key, double least, double most) {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  const double number = value->is_number() ? value->get<double>() : most + 1.0;
  if (number >= least && number <= most) return number;
  wrong(key, fmt::format("a number from {:g} to {:g} is wanted", least, most));
  return std::nullopt;
}

bool JsonReader::flag(const char* key) {
  const Json* value = find(key);
  if (value != nullptr && !value->is_boolean()) wrong(key, "true or false is wanted");
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

std::vector<std::string> JsonReader::texts(const char* key) {
  std::vector<std::string> all;
  const Json* value = find(key);
  if (value == nullptr) return all;
  if (!value->is_array()) wrong(key, "a list of texts is wanted");
  for (const Json& element : value->is_array() ? *value : Json::array()) {
    if (!element.is_string()) wrong(key, "a list of texts is wanted");
    if (element.is_string()) all.push_back(element.get<std::string>());
  }
  return all;
}

std::vector<double> JsonReader::numbers(const char* key, double least, double most) {
  std::vector<double> all;
  const Json* value = find(key);
  if (value == nullptr) return all;
  const auto add = [&](const Json& element) {
    const double number = element.is_number() ? element.get<double>() : most + 1.0;
    if (!(number >= least && number <= most))
      wrong(key, fmt::format("numbers from {:g} to {:g} are wanted", least, most));
    all.push_back(number);
  };
  if (value->is_array())
    for (const Json& element : *value) add(element);
  else
    add(*value);
  return all;
}

std::vector<JsonReader> JsonReader::objects(const char* key) {
  std::vector<JsonReader> all;
  const Json* value = find(key);
  if (value == nullptr) return all;
  const std::string place = path_.empty() ? key : path_ + "." + key;
  if (!value->is_array()) {
    all.emplace_back(*value, place, *fault_);
    return all;
  }
  for (std::size_t i = 0; i < value->size(); ++i)
    all.emplace_back((*value)[i], fmt::format("{}[{}]", place, i), *fault_);
  return all;
}

std::optional<JsonReader> JsonReader::object(const char* key) {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return JsonReader(*value, path_.empty() ? key : path_ + "." + key, *fault_);
}

std::size_t JsonReader::word(const char* key, const std::vector<std::string_view>& words) {
  const Json* value = find(key);
  if (value == nullptr) return 0;
  if (value->is_string()) {
    const auto found = std::find(words.begin(), words.end(), value->get_ref<const std::string&>());
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  wrong(key, fmt::format("one of {} is wanted", fmt::join(words, ", ")));
  return 0;
}

void JsonReader::finish() {
  if (!object_->is_object()) return;
  for (const auto& [key, value] : object_->items())
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      wrong(key, "no such member is known here; there are " + fmt::format("{}", fmt::join(asked_, ", ")));
}

Result<nlohmann::json> parseJson(std::string_view text, const std::string& where) {
  // Depth is looked at first: the parser goes as deep as it is led.
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return fail(ErrorCode::input, "is nested too deeply", where);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return fail(ErrorCode::input, "is not JSON", where);
  return document;
}

}  // namespace umbrage::rules::detail
