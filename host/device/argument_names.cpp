#include "device/argument_names.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace phlux::device {
namespace {

// The C++ bindings may return strings with their terminating 0.
std::string without_end(const std::string& text) {
  return text.substr(0, text.find('\0'));
}

std::vector<std::string> names_of(const cl::Kernel& kernel) {
  std::vector<std::string> names;
  const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
  for (cl_uint i = 0; i < count; ++i) names.push_back(without_end(kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i)));
  return names;
}

} // namespace

ArgumentNames argument_names(cl::Program program) {
  ArgumentNames names;
  std::vector<cl::Kernel> kernels;
  program.createKernels(&kernels);
  for (const cl::Kernel& kernel : kernels) {
    const std::string name = without_end(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>());
    try {
      names[name] = names_of(kernel);
    } catch (const cl::Error&) { // CL_KERNEL_ARG_INFO_NOT_AVAILABLE
      names.erase(name);
    }
  }
  return names;
}

// A line per kernel with its name and those of its arguments; a 0 byte; the binary.
std::vector<unsigned char> encode(const NamedBinary& named) {
  std::string text;
  for (const auto& [kernel, arguments] : named.arguments)
    text += fmt::format("{} {}\n", kernel, fmt::join(arguments, " "));
  std::vector<unsigned char> bytes(text.begin(), text.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), named.binary.begin(), named.binary.end());
  return bytes;
}

NamedBinary decode(const std::vector<unsigned char>& bytes) {
  NamedBinary named;
  const auto end = std::ranges::find(bytes, 0);
  std::istringstream lines(std::string(bytes.begin(), end));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kernel;
    words >> kernel;
    std::vector<std::string>& arguments = named.arguments[kernel];
    for (std::string argument; words >> argument;) arguments.push_back(argument);
  }
  if (end != bytes.end()) named.binary.assign(end + 1, bytes.end());
  return named;
}

} // namespace phlux::device
