#pragma once

#include <string>

#include "umbrage/base/error.hpp"

namespace umbrage::demo {

class Demo;

/// What a key did, in words for the status line.
using Said = Result<std::string>;

struct Key {
  int code;          ///< Qt::Key
  const char* name;  ///< as the help names it
  const char* help;  ///< what it does; keys with one row in the help have the text at the first
  bool repeats;      ///< goes on while it is held down
  bool actionOnly;   ///< in viewer mode it is the viewer's
  Said (*press)(Demo&);
};

/// The key with this Qt::Key, or null.
[[nodiscard]] const Key* keyOf(int code);

/// The key that the help names so, or null.
[[nodiscard]] const Key* keyNamed(const std::string& name);

/// All keys and modes, for --help.
[[nodiscard]] std::string keyHelp();

}  // namespace umbrage::demo
