#include "umbrage/io/reader/json_access.hpp"

#include "umbrage/base/json_depth.hpp"
#include "umbrage/io/reader/files.hpp"

namespace umbrage::io::reader {

Result<Json> parseJson(std::string_view text) {
  if (auto fine = checkJsonDepth(text, kMaxJsonDepth); !fine) return tl::unexpected(fine.error());
  try {
    return Json::parse(text);
  } catch (const Json::exception& fault) {
    const std::string message = fault.what();
    const auto begin = message.find("] ");
    return fail(ErrorCode::input,
                "is not valid JSON: " + (begin == std::string::npos ? message : message.substr(begin + 2)));
  }
}

}  // namespace umbrage::io::reader
