// Builds OpenCL programs from kernel files: include expansion, options, binary cache.
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
  std::map<std::string, std::string> defines; ///< macro -> value; becomes text at the top, not options

  std::map<std::string, std::string> files; ///< name -> text of generated and users' files
  std::string extra; ///< text after `root`, such as a test's kernels; may include files
};

/// One self-contained text: the defines, then `root` with the first #include "file" of each file replaced by
/// that file, with #line tags, so that compilers' messages name the kernel file. `#include NAME` takes the
/// file from the define NAME. Conditions are left to the compiler.
/// @throws DeviceError "FILE:LINE: ..." when a file is missing
[[nodiscard]] std::string expand(const sources::KernelFiles& files, const ProgramSource& source);

/// `text` without #line tags, blank lines and comment lines, which do not change the program.
[[nodiscard]] std::string significant(const std::string& text);

struct BuiltProgram {
  cl::Program program;
  bool from_cache = false; ///< loaded from phlux's or the driver's cache
  double seconds = 0.0;
  ArgumentNames arguments; ///< of its kernels
};

/// Builds for one device, or loads from the binary cache, whose key is text, options, device, driver and
/// phlux's version. Where the device's compiler rejects the processor's own instructions in the lanes, this
/// program and all later ones for the device are built with portable lanes. `slow` is called once, from
/// another thread, when building takes longer than 200 ms.
/// @throws DeviceError with file and line of the first error; the compiler's full log is logged for debugging
[[nodiscard]] BuiltProgram build(const Device& device, const sources::KernelFiles& files,
                                 const ProgramSource& source, const std::function<void()>& slow = {});

/// Whether programs for the device are built with portable lanes.
[[nodiscard]] bool portable_lanes(const Device& device);

/// OpenCL C options for every program, then those of the environment variable PHLUX_KERNEL_OPTIONS (tests:
/// -Werror).
[[nodiscard]] std::string build_options();

/// The first error of a compiler's log as "FILE:LINE: message"; FILE is a kernel file even where the compiler
/// counts lines of `text`, the expanded program. Empty when no error has a file and line.
[[nodiscard]] std::string first_error(const std::string& log, const std::string& text);

} // namespace phlux::device
