#include "verify/device_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "device/work_groups.h"
#include "render/parts.h"

namespace phlux::verify {
namespace {

constexpr std::size_t sample_values = 10, pair_values = 10; // planes of verify.cl

device::ProgramSource source_of(const std::string& strategy, int lanes,
                                const std::vector<lobes::ModelPointer>& models) {
  render::Parts parts;
  parts.lanes = lanes;
  parts.strategy = strategy;
  parts.models = models;
  return parts.source("measure/verify.cl");
}

template<typename T>
cl::Buffer buffer_of(const device::Device& device, const std::vector<T>& values) {
  cl::Buffer buffer(device.context, CL_MEM_READ_ONLY, std::max<std::size_t>(1, values.size()) * sizeof(T));
  if (!values.empty())
    device.queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, values.size() * sizeof(T), values.data());
  return buffer;
}

cl_uint set_fixed(cl::Kernel& kernel, cl_uint index, const Direction& fixed) {
  for (int axis = 0; axis < 3; ++axis) kernel.setArg(index++, static_cast<cl_float>(fixed[axis]));
  return index;
}

std::uint32_t coordinate(const Direction& direction, std::size_t axis) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(direction[static_cast<int>(axis)]));
}

constexpr cl_uint first_argument = 3; // after VERIFY_PARAMETERS

} // namespace

std::uint32_t word_for(double u) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(u * 0x1p23), 0.0, 0x1p23 - 1)) << 9;
}

DeviceModel::DeviceModel(const device::Device& device, const sources::KernelFiles& files, int lanes,
                         const std::string& strategy, const std::vector<scene::Material>& materials)
    : device_(device), lanes_(lanes) {
  const lobes::MaterialTable table = lobes::material_table(materials);
  program_ = device::build(device, files, source_of(strategy, lanes, table.models)).program;
  materials_ = buffer_of(device, table.records);
  table_ = buffer_of(device, table.tables);
}

std::size_t DeviceModel::elements_of_groups(std::size_t elements) const {
  return device::items_for(elements, lanes_) * static_cast<std::size_t>(lanes_);
}

template<class Word>
cl::Buffer DeviceModel::planes(std::size_t elements, std::size_t values, const Word& word) const {
  const std::size_t plane = elements_of_groups(elements);
  std::vector<std::uint32_t> words(values * plane);
  for (std::size_t k = 0; k < values; ++k)
    for (std::size_t i = 0; i < plane; ++i) words[k * plane + i] = word(std::min(i, elements - 1), k);
  return buffer_of(device_, words);
}

cl::Kernel DeviceModel::kernel(const char* name, int material) const {
  cl::Kernel kernel(program_, name);
  kernel.setArg(0, materials_);
  kernel.setArg(1, table_);
  kernel.setArg(2, static_cast<cl_int>(material));
  return kernel;
}

std::vector<float> DeviceModel::run(cl::Kernel& kernel, cl_uint last, std::size_t elements,
                                    std::size_t values) const {
  std::vector<float> results(elements_of_groups(elements) * values);
  const cl::Buffer memory(device_.context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
  kernel.setArg(last, memory);
  device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(device::items_for(elements, lanes_)),
                                     cl::NDRange(device::group_size(lanes_)));
  device_.queue.enqueueReadBuffer(memory, CL_TRUE, 0, results.size() * sizeof(float), results.data());
  return results;
}

std::vector<Sample> DeviceModel::run_samples(cl::Kernel& kernel, cl_uint last, std::size_t elements) const {
  const std::vector<float> results = run(kernel, last, elements, sample_values);
  const std::size_t plane = elements_of_groups(elements);
  std::vector<Sample> samples(elements);
  for (std::size_t i = 0; i < elements; ++i) {
    const auto at = [&](std::size_t k) -> double { return results[k * plane + i]; };
    samples[i] = {
        {at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6), at(7) != 0, static_cast<int>(at(8)), at(9) != 0};
  }
  return samples;
}

std::vector<Sample> DeviceModel::sample(int material, const Direction& fixed, std::size_t count,
                                        std::uint32_t seed, bool roulette, std::uint32_t first) const {
  cl::Kernel kernel = this->kernel("sample_model", material);
  cl_uint index = set_fixed(kernel, first_argument, fixed);
  kernel.setArg(index++, cl_uint2{{seed, 0x766572}}); // the second word separates it from renders' seeds
  kernel.setArg(index++, static_cast<cl_uint>(first));
  kernel.setArg(index++, static_cast<cl_int>(roulette));
  return run_samples(kernel, index, count);
}

std::vector<Sample> DeviceModel::drive(int material, const Direction& fixed, const std::vector<Words>& words,
                                       bool roulette) const {
  const cl::Buffer memory =
      planes(words.size(), 4, [&](std::size_t i, std::size_t k) { return words[i][k]; });
  cl::Kernel kernel = this->kernel("drive_model", material);
  cl_uint index = set_fixed(kernel, first_argument, fixed);
  kernel.setArg(index++, memory);
  kernel.setArg(index++, static_cast<cl_int>(roulette));
  return run_samples(kernel, index, words.size());
}

std::vector<PairValues> DeviceModel::evaluate(int material, const std::vector<Pair>& pairs) const {
  const std::size_t plane = elements_of_groups(pairs.size());
  const cl::Buffer memory = planes(pairs.size(), 6, [&](std::size_t i, std::size_t k) {
    return coordinate(k < 3 ? pairs[i].a : pairs[i].b, k % 3);
  });
  cl::Kernel kernel = this->kernel("evaluate_model", material);
  kernel.setArg(first_argument, memory);
  const std::vector<float> results = run(kernel, first_argument + 1, pairs.size(), pair_values);
  std::vector<PairValues> values(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto at = [&](std::size_t k) -> double { return results[k * plane + i]; };
    values[i] = {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6), at(7), at(8), at(9)};
  }
  return values;
}

std::vector<Rgb> DeviceModel::reflectivity(int material, const std::vector<Direction>& directions) const {
  const std::size_t plane = elements_of_groups(directions.size());
  const cl::Buffer memory = planes(
      directions.size(), 3, [&](std::size_t i, std::size_t k) { return coordinate(directions[i], k); });
  cl::Kernel kernel = this->kernel("integrate_model", material);
  kernel.setArg(first_argument, memory);
  const std::vector<float> results = run(kernel, first_argument + 1, directions.size(), 3);
  std::vector<Rgb> values(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i)
    values[i] = {results[i], results[plane + i], results[2 * plane + i]};
  return values;
}

std::vector<Rgb> DeviceModel::reflectivity(int material, const std::vector<double>& cosines) const {
  std::vector<Direction> directions;
  for (const double cosine : cosines) {
    const auto z = static_cast<float>(cosine);
    directions.emplace_back(std::sqrt((1 - z) * (1 + z)), 0, z);
  }
  return reflectivity(material, directions);
}

} // namespace phlux::verify
