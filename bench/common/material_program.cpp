#include "bench/common/material_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "errors.h"
#include "lobes/program.h"
#include "phong/reflectivity.h"
#include "render/parts.h"

namespace phlux::bench {
namespace {

device::ProgramSource source_of(const std::string& root, const std::string& strategy, int lanes,
                                std::map<std::string, std::string> more, const lobes::ModelPointer& model) {
  if (std::ranges::find(render::strategy_names(), strategy) == render::strategy_names().end())
    throw UsageError(fmt::format("strategy {}: unknown: must be one of {}", strategy,
                                 fmt::join(render::strategy_names(), ", ")));
  render::Parts parts;
  parts.lanes = lanes;
  parts.models = {model};
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

scene::Material material_of(const Case& one) {
  if (one.given) return *one.given;
  return lobes::phong(scene::Rgb(one.diffuse), scene::Rgb(one.specular), one.exponent);
}

sources::KernelFiles kernel_files(const std::filesystem::path& folder) {
  return folder.empty() ? sources::KernelFiles() : sources::KernelFiles(folder);
}

MaterialProgram::MaterialProgram(const device::Device& device, const sources::KernelFiles& files,
                                 const std::string& root, const std::string& strategy, int lanes,
                                 std::map<std::string, std::string> more_defines,
                                 const lobes::ModelPointer& model)
    : device_(device), strategy_(strategy), lanes_(lanes != 0 ? lanes : device.info.lanes),
      program_(device::build(device, files, source_of(root, strategy, lanes_, std::move(more_defines), model))
                   .program) {}

std::string MaterialProgram::text(const sources::KernelFiles& files, const std::string& root,
                                  const std::string& strategy, int lanes,
                                  std::map<std::string, std::string> more_defines,
                                  const lobes::ModelPointer& model) {
  return device::significant(
      device::expand(files, source_of(root, strategy, lanes, std::move(more_defines), model)));
}

void MaterialProgram::set_material(const Case& one) {
  if (one == material_) return;
  const lobes::MaterialTable table = lobes::material_table({material_of(one)});
  records_ = upload(table.records);
  tables_ = upload(table.tables.empty() ? std::vector<float>{0} : table.tables);
  material_ = one;
}

cl_uint MaterialProgram::bind_material(cl::Kernel& kernel) const {
  kernel.setArg(0, records_);
  kernel.setArg(1, tables_);
  return 2;
}

void MaterialProgram::fail(const cl::Error& error) const {
  throw DeviceError(
      fmt::format("{}: {} with strategy {}", device_.info.name, device::describe(error), strategy_));
}

} // namespace phlux::bench
