#include "cli/attempts.h"

#include "cli/spelling.h"
#include "terminal.h"

namespace phlux::cli {

int Attempts::report(int otherwise) const {
  for (const Error& error : errors_) print_error(error.what());
  return errors_.empty() ? otherwise : errors_.front().exit_code();
}

void print_error(const std::string& message) {
  const std::string text = with_options(message);
  tell("phlux: {}\n", text.substr(0, text.find('\n')));
}

} // namespace phlux::cli
