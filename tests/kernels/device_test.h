// Runs a test's kernels on the device under test (PHLUX_DEVICE, else the first CPU), at every width.
// A test's kernel processes one item of lanes at a time: an argument of lanes is `__global const T* x` and
// the kernel's item is x[get_global_id(0)], where T is Real, Int, Uint or a struct of them such as Vec3. On
// the host it is a vector with one element per lane: a number, or a struct of as many 4-byte members as T
// has.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "device/kernel.h"
#include "device_under_test.h"

namespace device_test {

/// Build of the lanes. `portable` excludes the code of lanes.h for particular processors.
struct Variant {
  int width = 1;
  bool portable = false;
};
inline constexpr Variant variants[] = {{1}, {4}, {8}, {16}, {16, true}};

inline std::ostream& operator<<(std::ostream& to, const Variant& v) {
  return to << "WIDTH " << v.width << (v.portable ? ", portable" : "");
}

using phlux::test::kernel_files;
using phlux::test::test_device;
using phlux::test::thinned;

/// Source of a file of tests/kernels: of the checkout, or on another machine (.ci/device) of the working
/// directory.
inline std::string read_file(const std::string& name) {
  std::ifstream file(std::string(PHLUX_SOURCE_DIR) + "/tests/kernels/" + name);
  if (!file) file.open("tests/kernels/" + name);
  if (!file) throw std::runtime_error("tests/kernels/" + name + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// An argument that the kernel fills: one element per lane.
template<typename T>
struct Out {
  std::vector<T>& values;
};
/// An argument in the layout of the host, read and written.
template<typename T>
struct Table {
  std::vector<T>& values;
};
template<typename T>
Out<T> out(std::vector<T>& values) {
  return {values};
}
template<typename T>
Table<T> table(std::vector<T>& values) {
  return {values};
}

/// Index of word `word` of element `element` if items have `width` elements of `words` words.
inline std::size_t lane_word(std::size_t element, std::size_t word, std::size_t words, std::size_t width) {
  return (element / width * words + word) * width + element % width;
}

class Program {
  using Fetches = std::vector<std::function<void()>>;

public:
  Program(Variant variant, const std::string& text, const std::map<std::string, std::string>& defines = {})
      : Program(variant, text, phlux::device::ProgramSource{"", defines, {}, ""}) {}

  /// Adds the text to `source`.
  Program(Variant variant, const std::string& text, phlux::device::ProgramSource source)
      : width_(static_cast<std::size_t>(variant.width)) {
    source.extra += text;
    source.defines["WIDTH"] = std::to_string(variant.width);
    if (variant.portable) source.defines["LANES_PORTABLE"] = "1";
    program_ = phlux::device::build(test_device(), kernel_files(), source);
  }

  [[nodiscard]] phlux::device::Kernel kernel(const std::string& name) const { return {program_, name}; }

  /// Runs a kernel over `count` lanes. Arguments: a vector (read), out(vector), table(vector) or a scalar.
  template<typename... Arguments>
  void run(const std::string& name, std::size_t count, const Arguments&... arguments) const {
    run_bound(kernel(name), count, arguments...);
  }

  /// run() for a kernel whose first arguments are already set.
  template<typename... Arguments>
  void run_bound(phlux::device::Kernel kernel, std::size_t count, const Arguments&... arguments) const {
    const std::size_t items = (count + width_ - 1) / width_;
    cl_uint first = kernel.first_unset();
    Fetches fetches; // also keep the buffers alive, which a kernel does not
    (set(kernel, first++, items, fetches, arguments), ...);
    test_device().queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange, cl::NDRange(items),
                                             cl::NDRange(1));
    test_device().queue.finish();
    for (const auto& fetch : fetches) fetch();
  }

private:
  using Words = std::vector<std::uint32_t>;

  template<typename T>
  void set(phlux::device::Kernel& kernel, cl_uint index, std::size_t, Fetches&, const T& scalar) const {
    kernel.set(index, scalar);
  }

  template<typename T>
  void set(phlux::device::Kernel& kernel, cl_uint index, std::size_t items, Fetches& fetches,
           const std::vector<T>& values) const {
    constexpr std::size_t words = sizeof(T) / 4;
    Words lanes(items * width_ * words);
    for (std::size_t i = 0; i < items * width_; ++i)
      for (std::size_t k = 0; k < words; ++k) {
        const T& value = values.at(std::min(i, values.size() - 1)); // lanes beyond the last element repeat it
        std::memcpy(&lanes[lane_word(i, k, words, width_)], reinterpret_cast<const char*>(&value) + 4 * k, 4);
      }
    const cl::Buffer memory = buffer(lanes.data(), lanes.size() * 4);
    kernel.set(index, memory);
    fetches.emplace_back([memory] {});
  }

  template<typename T>
  void set(phlux::device::Kernel& kernel, cl_uint index, std::size_t items, Fetches& fetches,
           const Out<T>& out) const {
    constexpr std::size_t words = sizeof(T) / 4;
    const std::size_t bytes = items * width_ * words * 4;
    const cl::Buffer memory(test_device().context, CL_MEM_READ_WRITE, bytes);
    kernel.set(index, memory);
    fetches.emplace_back([this, memory, bytes, &values = out.values] {
      Words lanes(bytes / 4);
      test_device().queue.enqueueReadBuffer(memory, CL_TRUE, 0, bytes, lanes.data());
      for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t k = 0; k < words; ++k)
          std::memcpy(reinterpret_cast<char*>(&values[i]) + 4 * k, &lanes[lane_word(i, k, words, width_)], 4);
    });
  }

  template<typename T>
  void set(phlux::device::Kernel& kernel, cl_uint index, std::size_t, Fetches& fetches,
           const Table<T>& table) const {
    const std::size_t bytes = table.values.size() * sizeof(T);
    const cl::Buffer memory = buffer(table.values.data(), bytes);
    kernel.set(index, memory);
    fetches.emplace_back([memory, bytes, &values = table.values] {
      test_device().queue.enqueueReadBuffer(memory, CL_TRUE, 0, bytes, values.data());
    });
  }

  static cl::Buffer buffer(void* values, std::size_t bytes) {
    return {test_device().context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, bytes, values};
  }

  std::size_t width_;
  phlux::device::BuiltProgram program_;
};

/// A program of tests/kernels/NAME, built at its first use and never released.
inline const Program& program_with(const std::string& name, Variant variant,
                                   const phlux::device::ProgramSource& source) {
  static auto& programs = *new std::map<std::string, Program>;
  std::ostringstream key;
  key << name << ' ' << variant;
  for (const auto& [macro, value] : source.defines) key << ' ' << macro << '=' << value;
  for (const auto& [file, text] : source.files) key << ' ' << file << '=' << text;
  const auto found = programs.find(key.str());
  if (found != programs.end()) return found->second;
  return programs.emplace(key.str(), Program(variant, read_file(name), source)).first->second;
}
inline const Program& program_of(const std::string& name, Variant variant,
                                 const std::map<std::string, std::string>& defines = {}) {
  return program_with(name, variant, {"", defines, {}, ""});
}

} // namespace device_test
