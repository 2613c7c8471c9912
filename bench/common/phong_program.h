// A program of kernels/ that works on one Phong material without a scene (kernels/only_material.cl).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "device/program.h"
#include "device/work_groups.h"

namespace phlux::bench {

/// A colourless material and the angle of the direction that is known.
struct Case {
  double diffuse = 0, specular = 0, exponent = 0; ///< kd, ks, n
  double degrees = 0;                             ///< from the normal, below 90
  bool operator==(const Case&) const = default;
};

/// The reflectivity rho = rho_d + rho_s, in closed form and double precision.
[[nodiscard]] double exact_reflectivity(const Case& one);

/// The kernels to use: the embedded ones where `folder` is empty.
[[nodiscard]] sources::KernelFiles kernel_files(const std::filesystem::path& folder);

class PhongProgram {
public:
  /// The text that is built for these arguments of the constructor.
  [[nodiscard]] static std::string text(const sources::KernelFiles& files, const std::string& root,
                                        const std::string& strategy, int lanes,
                                        std::map<std::string, std::string> more_defines = {});

  /// Builds kernels/`root` for a strategy (render::strategy_names()) and a WIDTH (0: what suits the device).
  /// @throws UsageError for an unknown strategy, DeviceError
  PhongProgram(const device::Device& device, const sources::KernelFiles& files, const std::string& root,
               const std::string& strategy, int lanes, std::map<std::string, std::string> more_defines = {});

  /// The material of the launches to come; its tables go to the device where it is another one than before.
  void set_material(const Case& one);

  template<typename T>
  [[nodiscard]] cl::Buffer upload(const std::vector<T>& table) const {
    return {device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, table.size() * sizeof(T),
            const_cast<T*>(table.data())};
  }

  /// Launches a kernel of (material, reflectivities, `arguments`..., floats that it fills) with one lane for
  /// each of `elements`; returns the `values` floats. @throws DeviceError
  template<typename... Arguments>
  [[nodiscard]] std::vector<float> run(const std::string& name, std::size_t elements, std::size_t values,
                                       const Arguments&... arguments) const try {
    cl::Kernel kernel(program_, name.c_str());
    const cl::Buffer out(device_.context, CL_MEM_WRITE_ONLY, values * sizeof(float));
    cl_uint index = bind_material(kernel);
    (kernel.setArg(index++, arguments), ...);
    kernel.setArg(index, out);
    std::vector<float> result(values);
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                       cl::NDRange(device::items_for(elements, lanes_)),
                                       cl::NDRange(device::group_size(lanes_)));
    device_.queue.enqueueReadBuffer(out, CL_TRUE, 0, values * sizeof(float), result.data());
    return result;
  } catch (const cl::Error& error) {
    fail(error);
  }

  /// Sets the first arguments; returns the index of the next.
  cl_uint bind_material(cl::Kernel& kernel) const;
  [[nodiscard]] const cl::Program& program() const { return program_; }
  [[nodiscard]] const device::Device& device() const { return device_; }
  [[nodiscard]] int lanes() const { return lanes_; }
  [[noreturn]] void fail(const cl::Error& error) const; ///< as a DeviceError

private:
  device::Device device_;
  std::string strategy_;
  int lanes_;
  cl::Program program_;
  Case material_{-1, 0, 0, 0};
  cl::Buffer records_, reflectivity_;
};

} // namespace phlux::bench
