#include "bench/common/phong_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "errors.h"
#include "phong/reflectivity.h"
#include "render/parts.h"
#include "tables/material_table.h"

namespace phlux::bench {
namespace {

std::map<std::string, std::string> defines(const std::string& strategy, int lanes,
                                           std::map<std::string, std::string> more) {
  const auto& names = render::strategy_names(); // in the order of phong.cl's numbers, from 1
  const auto found = std::ranges::find(names, strategy);
  if (found == names.end())
    throw UsageError(fmt::format("--strategy {}: there is no such strategy", strategy));
  render::Parts parts;
  parts.lanes = lanes;
  parts.phong_lobe = true;
  parts.strategy = std::to_string(found - names.begin() + 1);
  more.merge(parts.defines());
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
  return one.diffuse + one.specular * phong::lobe_reflectivity(one.exponent, cosine);
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
  const tables::MaterialTable table = tables::material_table({material_of(one)});
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
