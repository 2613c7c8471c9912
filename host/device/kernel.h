// A kernel whose arguments are set by their names in its source.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "device/program.h"

namespace phlux::device {

class Kernel {
public:
  /// @throws DeviceError where the program has no kernel of that name, or nothing says what its arguments are
  /// called
  Kernel(const BuiltProgram& program, const std::string& name);

  /// Sets an argument; does nothing where the kernel has none of that name.
  /// @throws DeviceError for a value of another size than the kernel's
  template<class Value>
  void set(const std::string& argument, const Value& value) {
    if (const auto index = index_of(argument)) set(*index, value);
  }
  /// The same by position.
  template<class Value>
  void set(cl_uint index, const Value& value) {
    try {
      kernel_.setArg(index, value);
    } catch (const cl::Error& error) {
      fail(index, error);
    }
    is_set_.at(index) = true;
  }

  /// The first argument that has not been set; as many as there are where all have.
  [[nodiscard]] cl_uint first_unset() const;
  /// To be enqueued. @throws DeviceError naming the arguments that have not been set
  [[nodiscard]] const cl::Kernel& ready() const;

private:
  [[nodiscard]] std::optional<cl_uint> index_of(const std::string& argument) const;
  [[noreturn]] void fail(cl_uint index, const cl::Error& error) const;

  std::string name_;
  std::vector<std::string> arguments_; // their names
  std::vector<bool> is_set_;
  cl::Kernel kernel_;
};

} // namespace phlux::device
