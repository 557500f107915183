#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace umbrage {

/// Which door the world's fault came through; the command line turns it into its exit code.
enum class ErrorCode {
  usage,        ///< the request itself makes no sense (exit 2)
  input,        ///< a file or a mesh is missing, broken or too large (exit 3)
  unsupported,  ///< understood, but this build or version cannot do it (exit 3)
  output,       ///< a file cannot be written (exit 3)
  device,       ///< no graphics or other device for what was asked (exit 4)
  cancelled,    ///< the progress sink asked to stop (exit 1)
};

/// What went wrong in the world: `message` says what and how to remedy it, `where` the file and the element.
struct Error {
  ErrorCode code = ErrorCode::input;
  std::string message;
  std::string where;

  /// "where: message", or the message alone.
  [[nodiscard]] std::string text() const;
};

/// A value, or the world's fault that prevented it. Umbrage never throws.
template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand: `return fail(ErrorCode::input, "no faces", path);`
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string where = {});

/// Exit code of the command line for an error (see the enumerators).
[[nodiscard]] int exitCode(ErrorCode code);

}  // namespace umbrage
