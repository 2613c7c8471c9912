// A kernel whose arguments are set by their names in its source.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "device/program.h"

namespace phlux::device {

class Kernel {
public:
  /// @throws DeviceError where the program has no kernel of that name, or its arguments' names are not known
  Kernel(const BuiltProgram& program, const std::string& name);

  /// Sets an argument; does nothing if the kernel has none of that name.
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

  /// Index of the first argument that has not been set; the number of arguments if all have.
  [[nodiscard]] cl_uint first_unset() const;
  /// The kernel, to be enqueued. @throws DeviceError naming the arguments that have not been set
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
