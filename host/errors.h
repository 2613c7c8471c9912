// Errors that end a command, one type per exit code and cause. Any other exception is a defect of phlux.
#pragma once

#include <stdexcept>
#include <string>

namespace phlux {

/// what() is one line for the user: "FILE:LINE: what is wrong: what would be right". It names settings as
/// `NAME`, which the command line replaces by options.
class Error : public std::runtime_error {
public:
  Error(int exit_code, const std::string& line) : std::runtime_error(line), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

private:
  int exit_code_;
};

struct UsageError : Error {
  explicit UsageError(const std::string& line) : Error(2, line) {}
};
struct SceneError : Error { ///< a bad scene
  explicit SceneError(const std::string& line) : Error(3, line) {}
};
struct FileError : Error { ///< a bad input file other than a scene: an image, a checkpoint
  explicit FileError(const std::string& line) : Error(3, line) {}
};
struct DeviceError : Error { ///< no device, or it failed
  explicit DeviceError(const std::string& line) : Error(4, line) {}
};
struct WriteError : Error {
  explicit WriteError(const std::string& line) : Error(5, line) {}
};

} // namespace phlux
