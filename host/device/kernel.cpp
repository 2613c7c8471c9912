#include "device/kernel.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "errors.h"

namespace phlux::device {
namespace {

cl::Kernel create(const cl::Program& program, const std::string& name) {
  try {
    return {program, name.c_str()};
  } catch (const cl::Error& error) {
    throw DeviceError(fmt::format("kernel {}: {}", name, describe(error)));
  }
}

} // namespace

Kernel::Kernel(const BuiltProgram& program, const std::string& name)
    : name_(name), kernel_(create(program.program, name)) {
  const auto found = program.arguments.find(name);
  if (found == program.arguments.end())
    throw DeviceError(
        fmt::format("kernel {}: the driver does not say what its arguments are called: use another "
                    "device",
                    name));
  arguments_ = found->second;
  is_set_.resize(arguments_.size());
}

cl_uint Kernel::first_unset() const {
  return static_cast<cl_uint>(std::ranges::find(is_set_, false) - is_set_.begin());
}

const cl::Kernel& Kernel::ready() const {
  std::vector<std::string> unset;
  for (std::size_t i = 0; i < arguments_.size(); ++i)
    if (!is_set_[i]) unset.push_back(arguments_[i]);
  if (!unset.empty())
    throw DeviceError(fmt::format("kernel {}: nothing sets its {} {}: set each argument before it runs",
                                  name_, unset.size() > 1 ? "arguments" : "argument",
                                  fmt::join(unset, ", ")));
  return kernel_;
}

std::optional<cl_uint> Kernel::index_of(const std::string& argument) const {
  const auto found = std::ranges::find(arguments_, argument);
  if (found == arguments_.end()) return std::nullopt;
  return static_cast<cl_uint>(found - arguments_.begin());
}

void Kernel::fail(cl_uint index, const cl::Error& error) const {
  throw DeviceError(fmt::format("kernel {}, argument {}: {}", name_, arguments_.at(index), describe(error)));
}

} // namespace phlux::device
