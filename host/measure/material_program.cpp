#include "measure/material_program.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "errors.h"
#include "lobes/program.h"
#include "render/parts.h"

namespace phlux::measure {
namespace {

MaterialProgram::Source with_lanes(MaterialProgram::Source source, const device::Device& device) {
  if (source.lanes == 0) source.lanes = device.info.lanes;
  return source;
}

} // namespace

device::ProgramSource MaterialProgram::Source::program() const {
  render::Parts parts;
  parts.lanes = lanes;
  parts.models = models;
  parts.strategy = strategy;
  device::ProgramSource source = parts.source(root);
  for (const auto& [name, value] : defines) source.defines[name] = value;
  return source;
}

MaterialProgram::MaterialProgram(const device::Device& device, const sources::KernelFiles& files,
                                 Source source)
    : device_(device), source_(with_lanes(std::move(source), device)),
      program_(device::build(device, files, source_.program()).program) {}

void MaterialProgram::set_materials(const std::vector<scene::Material>& materials,
                                    const std::vector<float>& derived) {
  if (materials == materials_ && derived == derived_) return;
  lobes::MaterialTable table = lobes::material_table(materials, source_.models);
  std::ranges::copy(derived, table.records.end() - std::ssize(derived));
  records_ = upload(table.records);
  tables_ = upload(table.tables);
  materials_ = materials;
  derived_ = derived;
}

cl_uint MaterialProgram::bind_materials(cl::Kernel& kernel) const {
  kernel.setArg(0, records_);
  kernel.setArg(1, tables_);
  return 2;
}

void MaterialProgram::fail(const cl::Error& error) const {
  throw DeviceError(
      fmt::format("{}: {} with strategy {}", device_.info.name, device::describe(error), source_.strategy));
}

} // namespace phlux::measure
