#include "bench/common/phong_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "errors.h"
#include "lobes/program.h"
#include "phong/reflectivity.h"
#include "render/parts.h"

namespace phlux::bench {
namespace {

device::ProgramSource source_of(const std::string& root, const std::string& strategy, int lanes,
                                std::map<std::string, std::string> more) {
  if (std::ranges::find(render::strategy_names(), strategy) == render::strategy_names().end())
    throw UsageError(fmt::format("--strategy {}: there is no such strategy", strategy));
  render::Parts parts;
  parts.lanes = lanes;
  parts.models = {lobes::shipped("phong")};
  parts.strategy = strategy;
  device::ProgramSource source = parts.source(root);
  source.defines.merge(more);
  return source;
}

} // namespace

double exact_reflectivity(const Case& one) {
  const double cosine = std::cos(one.degrees * std::numbers::pi / 180);
  return one.diffuse + one.specular * phong::lobe_reflectivity(one.exponent, cosine);
}

sources::KernelFiles kernel_files(const std::filesystem::path& folder) {
  return folder.empty() ? sources::KernelFiles() : sources::KernelFiles(folder);
}

PhongProgram::PhongProgram(const device::Device& device, const sources::KernelFiles& files,
                           const std::string& root, const std::string& strategy, int lanes,
                           std::map<std::string, std::string> more_defines)
    : device_(device), strategy_(strategy), lanes_(lanes != 0 ? lanes : device.info.lanes),
      program_(
          device::build(device, files, source_of(root, strategy, lanes_, std::move(more_defines))).program) {}

std::string PhongProgram::text(const sources::KernelFiles& files, const std::string& root,
                               const std::string& strategy, int lanes,
                               std::map<std::string, std::string> more_defines) {
  return device::significant(
      device::expand(files, source_of(root, strategy, lanes, std::move(more_defines))));
}

void PhongProgram::set_material(const Case& one) {
  if (one == material_) return;
  const lobes::MaterialTable table =
      lobes::material_table({lobes::phong(scene::Rgb(one.diffuse), scene::Rgb(one.specular), one.exponent)});
  records_ = upload(table.records);
  reflectivity_ = upload(table.tables.empty() ? std::vector<float>{0} : table.tables);
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
