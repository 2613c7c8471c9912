// The phlux program: its command line, its one-line errors and its exit codes.
#pragma once

namespace phlux::cli {

/// Runs one command. Returns the exit code (README.md); a defect of phlux itself ends with 70 (EX_SOFTWARE).
[[nodiscard]] int run(int argc, char** argv);

} // namespace phlux::cli
