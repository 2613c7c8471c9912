// Parses the command line.
#pragma once

#include <functional>
#include <optional>

#include "cli/options.h"

namespace phlux::cli {

/// A command with all its options, ready to run; returns the exit code.
using Command = std::function<int()>;

/// Parses the command line. Returns no command where it asks for help or the version, which are printed here.
/// @throws UsageError
[[nodiscard]] std::optional<Command> parse(int argc, char** argv);

} // namespace phlux::cli
