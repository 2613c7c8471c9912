// An OpenCL program that measures reflectance models without a scene: kernels/measure/FILE.cl, whose first
// arguments are the records of materials and the tables of their models.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "device/program.h"
#include "device/work_groups.h"
#include "lobes/models.h"

namespace phlux::measure {

class MaterialProgram {
public:
  struct Source {
    std::string root; ///< such as "measure/figures.cl"
    std::vector<lobes::ModelPointer> models = {lobes::shipped("phong")};
    std::string strategy = "exact"; ///< of the Phong model
    int lanes = 0;                  ///< WIDTH; 0: the device's default
    std::map<std::string, std::string> defines = {};

    [[nodiscard]] device::ProgramSource program() const;
  };

  /// @throws DeviceError
  MaterialProgram(const device::Device& device, const sources::KernelFiles& files, Source source);

  /// The materials of later launches: of models of the source. Uploads their records if they have changed.
  /// `derived`: the last of the derived words of the last material, in place of those that the model has.
  void set_materials(const std::vector<scene::Material>& materials, const std::vector<float>& derived = {});

  template<typename T>
  [[nodiscard]] cl::Buffer upload(const std::vector<T>& table) const {
    return {device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, table.size() * sizeof(T),
            const_cast<T*>(table.data())};
  }

  /// Launches a kernel with the arguments (records, tables, `arguments`..., output), one lane per element.
  /// Returns the output, `values` floats. @throws DeviceError
  template<typename... Arguments>
  [[nodiscard]] std::vector<float> run(const std::string& name, std::size_t elements, std::size_t values,
                                       const Arguments&... arguments) const try {
    cl::Kernel kernel(program_, name.c_str());
    const cl::Buffer out(device_.context, CL_MEM_WRITE_ONLY, values * sizeof(float));
    cl_uint index = bind_materials(kernel);
    (kernel.setArg(index++, arguments), ...);
    kernel.setArg(index, out);
    std::vector<float> result(values);
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange,
                                       cl::NDRange(device::items_for(elements, source_.lanes)),
                                       cl::NDRange(device::group_size(source_.lanes)));
    device_.queue.enqueueReadBuffer(out, CL_TRUE, 0, values * sizeof(float), result.data());
    return result;
  } catch (const cl::Error& error) {
    fail(error);
  }

  /// Sets the first arguments; returns the index of the next one.
  cl_uint bind_materials(cl::Kernel& kernel) const;
  [[nodiscard]] const cl::Program& program() const { return program_; }
  [[nodiscard]] const device::Device& device() const { return device_; }
  [[nodiscard]] int lanes() const { return source_.lanes; }
  [[noreturn]] void fail(const cl::Error& error) const; ///< @throws DeviceError

private:
  device::Device device_;
  Source source_;
  cl::Program program_;
  std::vector<scene::Material> materials_;
  std::vector<float> derived_;
  cl::Buffer records_, tables_;
};

} // namespace phlux::measure
