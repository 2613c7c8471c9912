#include "bench/common/phong_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "errors.h"
#include "render/material_table.h"
#include "render/parts.h"

namespace phlux::bench {
namespace {

std::map<std::string, std::string> defines(const std::string& strategy, int lanes,
                                           std::map<std::string, std::string> more) {
  const auto& names = render::strategy_names(); // in the order of the numbers in phong.cl, which begin at 1
  const auto found = std::ranges::find(names, strategy);
  if (found == names.end())
    throw UsageError(
        fmt::format("strategy {}: unknown: must be one of {}", strategy, fmt::join(names, ", ")));
  more["WIDTH"] = std::to_string(lanes);
  more["PHLUX_PHONG_LOBE"] = "1";
  more["PHLUX_STRATEGY"] = std::to_string(found - names.begin() + 1);
  more["PHONG_TABLE_INTERVALS"] = std::to_string(render::reflectivity_intervals);
  return more;
}

scene::Material material_of(const Case& one) {
  scene::Material material;
  material.diffuse = scene::Rgb(one.diffuse);
  material.specular = scene::Rgb(one.specular);
  material.exponent_u = one.exponent;
  return material;
}

} // namespace

double exact_reflectivity(const Case& one) {
  const double cosine = std::cos(one.degrees * std::numbers::pi / 180);
  return one.diffuse + one.specular * render::lobe_reflectivity(one.exponent, cosine);
}

device::KernelFiles kernel_files(const std::filesystem::path& folder) {
  return folder.empty() ? device::KernelFiles() : device::KernelFiles(folder);
}

PhongProgram::PhongProgram(const device::Device& device, const device::KernelFiles& files,
                           const std::string& root, const std::string& strategy, int lanes,
                           std::map<std::string, std::string> more_defines)
    : device_(device), strategy_(strategy), lanes_(lanes != 0 ? lanes : device.info.lanes),
      program_(device::build(device, files, {root, defines(strategy, lanes_, std::move(more_defines)), {}})
                   .program) {}

std::string PhongProgram::text(const device::KernelFiles& files, const std::string& root,
                               const std::string& strategy, int lanes,
                               std::map<std::string, std::string> more_defines) {
  return device::significant(
      device::expand(files, {root, defines(strategy, lanes, std::move(more_defines)), {}}));
}

void PhongProgram::set_material(const Case& one) {
  if (one == material_) return;
  const render::MaterialTable table = render::material_table({material_of(one)});
  records_ = upload(table.records);
  reflectivity_ = upload(table.reflectivity.empty() ? std::vector<float>{0} : table.reflectivity);
  material_ = one;
}

cl_uint PhongProgram::bind_material(cl::Kernel& kernel) const {
  kernel.setArg(0, records_);
  kernel.setArg(1, reflectivity_);
  return 2;
}

void PhongProgram::fail(const cl::Error& error) const {
  throw DeviceError(
      fmt::format("{}: {} with strategy {}", device_.info.name, device::describe(error), strategy_));
}

} // namespace phlux::bench
