// From kernel files to a built OpenCL program: include expansion, options, the binary cache.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "device/argument_names.h"
#include "device/device.h"
#include "sources/kernel_files.h"

namespace phlux::device {

struct ProgramSource {
  std::string root;                           ///< the kernel file to build, e.g. "path.cl"
  std::map<std::string, std::string> defines; ///< macro -> value; becomes text at the top, not -D options

  /// Files that are not in kernels/, by the name by which others include them: generated ones, a user's own.
  std::map<std::string, std::string> files;

  /// Adds kernels that are not in kernels/, such as a test's: text that may include kernel files, after
  /// `root`.
  std::string extra;
};

/// One self-contained text: the defines, then `root` with every #include "file" replaced by that file once,
/// each part tagged with #line so that compilers' messages name the kernel file. `#include NAME` takes the
/// file from the define NAME. Conditions are left to the compiler.
/// @throws DeviceError "FILE:LINE: ..." when a file is missing
[[nodiscard]] std::string expand(const sources::KernelFiles& files, const ProgramSource& source);

/// `text` without #line tags, blank lines and lines of comment: equal for two texts that make the same
/// program.
[[nodiscard]] std::string significant(const std::string& text);

struct BuiltProgram {
  cl::Program program;
  bool from_cache = false; ///< it had been built before and was kept, by phlux or by the driver
  double seconds = 0.0;
  ArgumentNames arguments; ///< of its kernels
};

/// Builds for one device, from the binary cache where it can. The cache is keyed by text, options, device,
/// driver and phlux's version. Where the device's compiler refuses the processor's own instructions in the
/// lanes, the program is built with portable lanes, and so is every later one for that device. `slow` is
/// called once, from another thread, when building takes longer than 200 ms.
/// @throws DeviceError naming file and line of the first error when the build fails; the full log goes to the
/// log
[[nodiscard]] BuiltProgram build(const Device& device, const sources::KernelFiles& files,
                                 const ProgramSource& source, const std::function<void()>& slow = {});

/// Whether programs for the device have had to be built with portable lanes.
[[nodiscard]] bool portable_lanes(const Device& device);

/// OpenCL C options for every program, then those of the environment variable PHLUX_KERNEL_OPTIONS (tests:
/// -Werror).
[[nodiscard]] std::string build_options();

/// The first error of a compiler's log as "FILE:LINE: message", FILE being a kernel file even where the
/// compiler counts lines of `text`, the expanded program; empty when the log has none with a place.
[[nodiscard]] std::string first_error(const std::string& log, const std::string& text);

} // namespace phlux::device
