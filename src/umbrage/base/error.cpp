#include "umbrage/base/error.hpp"

#include <utility>

namespace umbrage {

std::string Error::text() const { return where.empty() ? message : where + ": " + message; }

tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string where) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(where)});
}

int exitCode(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage: return 2;
    case ErrorCode::input:
    case ErrorCode::unsupported:
    case ErrorCode::output: return 3;
    case ErrorCode::device: return 4;
    case ErrorCode::cancelled: return 1;
  }
  return 3;
}

}  // namespace umbrage
