#include "umbrage/rules/detail/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "umbrage/base/json_depth.hpp"

namespace umbrage::rules::detail {
namespace {

constexpr int kDeepest = 64;  // no rule and no map of areas is nested deeper

std::string below(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : key.empty() ? path : fmt::format("{}.{}", path, key);
}

/// Goes through a document and remembers the first fault, and at which member it stands.
class StrictWalk final : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] const std::string& fault() const { return fault_; }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }

  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second) fault_ = path() + ": is there twice; leave one of them out";
    return fault_.empty();
  }
  bool parse_error(std::size_t byte, const std::string&, const nlohmann::json::exception& problem) override {
    constexpr int kOutOfRange = 406;
    const std::string at = path();
    if (problem.id == kOutOfRange)
      fault_ = at + ": the number is too large";
    else
      fault_ = fmt::format("is not JSON from byte {} on{}", byte, at.empty() ? "" : ", in " + at);
    return false;
  }

 private:
  struct Level {
    bool array = false;
    std::size_t index = 0;
    std::string key;
    std::set<std::string> keys;
  };
  bool open(bool array) {
    levels_.push_back({array, 0, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }
  bool value() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }
  [[nodiscard]] std::string path() const {
    std::string path;
    for (const Level& level : levels_)
      if (level.array)
        path += fmt::format("[{}]", level.index);
      else
        path = below(path, level.key);
    return path;
  }

  std::vector<Level> levels_;
  std::string fault_;
};

Result<void> checkDepth(std::string_view text, const std::string& where) {
  const auto fine = checkJsonDepth(text, kDeepest);
  return fine ? fine : fail(ErrorCode::input, fine.error().message, where);
}

}  // namespace

JsonReader::JsonReader(const Json& object, std::string path, std::string& fault)
    : object_(&object), path_(std::move(path)), fault_(&fault) {
  if (!object.is_object()) wrong("", "an object {..} is wanted");
}

void JsonReader::wrong(const std::string& key, const std::string& what) {
  if (!fault_->empty()) return;
  const std::string place = below(path_, key);
  *fault_ = place.empty() ? what : place + ": " + what;
}

const JsonReader::Json* JsonReader::find(const char* key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  if (!object_->is_object()) return nullptr;
  const auto found = object_->find(key);
  return found == object_->end() ? nullptr : &*found;
}

bool JsonReader::has(const char* key) { return find(key) != nullptr; }

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

std::optional<int> JsonReader::whole(const char* key, int least, int most) {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  const double number = value->is_number() ? value->get<double>() : double(most) + 1.0;
  if (number >= least && number <= most && number == std::floor(number)) return static_cast<int>(number);
  wrong(key, fmt::format("a whole number from {} to {} is wanted", least, most));
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
  const std::size_t count = value->is_array() ? value->size() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Json& element = (*value)[i];
    if (!element.is_string()) wrong(fmt::format("{}[{}]", key, i), "a text is wanted");
    if (element.is_string()) all.push_back(element.get<std::string>());
  }
  return all;
}

std::vector<double> JsonReader::numbers(const char* key, double least, double most) {
  std::vector<double> all;
  const Json* value = find(key);
  if (value == nullptr) return all;
  const auto add = [&](const Json& element, const std::string& place) {
    const double number = element.is_number() ? element.get<double>() : most + 1.0;
    if (!(number >= least && number <= most))
      wrong(place, fmt::format("a number from {:g} to {:g} is wanted", least, most));
    all.push_back(number);
  };
  if (!value->is_array()) add(*value, key);
  for (std::size_t i = 0; value->is_array() && i < value->size(); ++i) add((*value)[i], fmt::format("{}[{}]", key, i));
  return all;
}

std::vector<JsonReader> JsonReader::objects(const char* key) {
  std::vector<JsonReader> all;
  const Json* value = find(key);
  if (value == nullptr) return all;
  const std::string place = below(path_, key);
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
  return JsonReader(*value, below(path_, key), *fault_);
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
  if (const auto fine = checkDepth(text, where); !fine) return tl::unexpected(fine.error());
  nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return fail(ErrorCode::input, "is not JSON", where);
  return document;
}

Result<nlohmann::json> parseStrictJson(std::string_view text, const std::string& where) {
  if (const auto fine = checkDepth(text, where); !fine) return tl::unexpected(fine.error());
  StrictWalk walk;
  if (!nlohmann::json::sax_parse(text, &walk)) return fail(ErrorCode::input, walk.fault(), where);
  return parseJson(text, where);
}

}  // namespace umbrage::rules::detail
