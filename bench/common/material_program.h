// An OpenCL program for one material without a scene (kernels/measure/only_material.cl).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "device/program.h"
#include "device/work_groups.h"
#include "lobes/models.h"

namespace phlux::bench {

/// A material, a grey Phong unless it is given, and the angle of the fixed direction.
struct Case {
  double diffuse = 0, specular = 0, exponent = 0; ///< kd, ks, n
  double degrees = 0;                             ///< between the fixed direction and the normal; below 90
  std::shared_ptr<const scene::Material> given;   ///< of another model; null: the Phong material
  bool operator==(const Case&) const = default;
};

/// The reflectivity rho = rho_d + rho_s of the Phong material for the fixed direction, in closed form and
/// double precision.
[[nodiscard]] double exact_reflectivity(const Case& one);

[[nodiscard]] scene::Material material_of(const Case& one);

/// The kernels in `folder`; the embedded ones if it is empty.
[[nodiscard]] sources::KernelFiles kernel_files(const std::filesystem::path& folder);

class MaterialProgram {
public:
  /// The source that the constructor builds for the same arguments.
  [[nodiscard]] static std::string text(const sources::KernelFiles& files, const std::string& root,
                                        const std::string& strategy, int lanes,
                                        std::map<std::string, std::string> more_defines = {},
                                        const lobes::ModelPointer& model = lobes::shipped("phong"));

  /// Builds kernels/`root` for materials of a model, a strategy of the Phong model (render::strategy_names())
  /// and WIDTH `lanes` (0: the device's default).
  /// @throws UsageError for an unknown strategy, DeviceError
  MaterialProgram(const device::Device& device, const sources::KernelFiles& files, const std::string& root,
                  const std::string& strategy, int lanes,
                  std::map<std::string, std::string> more_defines = {},
                  const lobes::ModelPointer& model = lobes::shipped("phong"));

  /// Sets the material of later launches. Uploads its tables if it has changed.
  void set_material(const Case& one);

  template<typename T>
  [[nodiscard]] cl::Buffer upload(const std::vector<T>& table) const {
    return {device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, table.size() * sizeof(T),
            const_cast<T*>(table.data())};
  }

  /// Launches a kernel with the arguments (material, reflectivities, `arguments`..., output), one lane per
  /// element. Returns the output, `values` floats. @throws DeviceError
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

  /// Sets the arguments for the material, the first ones; returns the index of the next argument.
  cl_uint bind_material(cl::Kernel& kernel) const;
  [[nodiscard]] const cl::Program& program() const { return program_; }
  [[nodiscard]] const device::Device& device() const { return device_; }
  [[nodiscard]] int lanes() const { return lanes_; }
  [[noreturn]] void fail(const cl::Error& error) const; ///< @throws DeviceError

private:
  device::Device device_;
  std::string strategy_;
  int lanes_;
  cl::Program program_;
  Case material_{-1, 0, 0, 0, nullptr};
  cl::Buffer records_, tables_;
};

} // namespace phlux::bench
