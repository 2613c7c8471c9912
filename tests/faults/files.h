// Makes calls that write files fail at random: of a program that links this library, or in which it is
// preloaded. Then the environment variable PHLUX_FILE_FAULTS="SEED PROBABILITY FOLDER" plans them.
#pragma once

#include <string>

namespace faults {

/// From now on each open() for writing, write(), fsync() and rename() below `folder` fails with this
/// probability, by ENOSPC or EIO; a write() that is about to fail first writes half of its bytes.
void plan_file_faults(unsigned seed, double probability, const std::string& folder);

/// The faults since then.
[[nodiscard]] long file_faults();

} // namespace faults
