// The grammar of the command line.
#pragma once

#include <functional>
#include <optional>

#include "cli/options.h"

namespace phlux::cli {

/// A command with all its options, ready to run; returns the exit code.
using Command = std::function<int()>;

/// Parses the command line. Help and the version are printed here; then there is no command.
/// @throws UsageError
[[nodiscard]] std::optional<Command> parse(int argc, char** argv);

} // namespace phlux::cli
