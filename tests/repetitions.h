// Tests that an environment variable makes longer.
#pragma once

#include <cstdlib>

/// The number that the variable has; `usual` if it is not set.
[[nodiscard]] inline int repetitions(const char* variable, int usual) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : usual;
}
