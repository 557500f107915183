#include "arguments.hpp"

#include <algorithm>

#include "parse.hpp"

namespace umbrage::cli {
namespace {

// A number, or what its writer meant to be one ("nan", "1e999"): those belong to --ground too, where they are refused
// by name.
bool looksLikeNumber(const std::string& word) {
  if (parseNumber(word)) return true;
  std::string bare = word;
  if (bare.starts_with('-') || bare.starts_with('+')) bare.erase(0, 1);
  std::transform(bare.begin(), bare.end(), bare.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (bare == "nan" || bare == "inf" || bare == "infinity") return true;
  return !bare.empty() && bare.find_first_not_of("0123456789.e+-") == std::string::npos && bare.front() != 'e';
}

}  // namespace

std::vector<std::string> completeGround(const std::vector<std::string>& words) {
  std::vector<std::string> complete;
  const auto end = std::find(words.begin(), words.end(), "--");
  for (auto word = words.begin(); word != end; ++word) {
    if (*word != "--ground") {
      complete.push_back(*word);
    } else if (word + 1 != end && looksLikeNumber(word[1])) {
      complete.push_back("--ground=" + word[1]);
      ++word;
    } else {
      complete.push_back(std::string("--ground=") + kLowestGround);
    }
  }
  complete.insert(complete.end(), end, words.end());
  return complete;
}

}  // namespace umbrage::cli
