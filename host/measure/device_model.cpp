#include "measure/device_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lobes/program.h"

namespace phlux::measure {
namespace {

constexpr std::size_t sample_values = 10, pair_values = 10; // planes of verify.cl

std::uint32_t word_of(double component) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(component));
}

// One element's vector, whose components are in the planes first, first + 1 and first + 2.
Rgb vector_at(const std::vector<float>& planes, std::size_t plane, std::size_t first, std::size_t element) {
  const auto at = [&](std::size_t k) { return planes[(first + k) * plane + element]; };
  return {at(0), at(1), at(2)};
}

} // namespace

std::uint32_t word_for(double u) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(u * 0x1p23), 0.0, 0x1p23 - 1)) << 9;
}

DeviceModel::DeviceModel(const device::Device& device, const sources::KernelFiles& files, int lanes,
                         const std::string& strategy, const std::vector<scene::Material>& materials,
                         std::map<std::string, std::string> defines)
    : program_(device, files,
               {"measure/verify.cl", lobes::models_of(materials), strategy, lanes, std::move(defines)}) {
  program_.set_materials(materials);
}

std::size_t DeviceModel::plane_of(std::size_t elements) const {
  return device::items_for(elements, program_.lanes()) * static_cast<std::size_t>(program_.lanes());
}

template<typename Value>
cl::Buffer DeviceModel::planes(std::size_t elements, std::size_t values, const Value& value) const {
  const std::size_t plane = plane_of(elements);
  std::vector<std::uint32_t> words(values * plane);
  for (std::size_t i = 0; i < plane; ++i)
    for (std::size_t k = 0; k < values; ++k) words[k * plane + i] = value(std::min(i, elements - 1), k);
  return program_.upload(words);
}

template<typename... Arguments>
std::vector<Sample> DeviceModel::run_samples(const char* kernel, int material, const Direction& fixed,
                                             std::size_t elements, const Arguments&... arguments) const {
  const std::size_t plane = plane_of(elements);
  const std::vector<float> results =
      program_.run(kernel, elements, sample_values * plane, cl_int{material}, static_cast<cl_float>(fixed.x),
                   static_cast<cl_float>(fixed.y), static_cast<cl_float>(fixed.z), arguments...);
  std::vector<Sample> samples(elements);
  for (std::size_t i = 0; i < elements; ++i) {
    const auto at = [&](std::size_t k) -> double { return results[k * plane + i]; };
    samples[i] = {vector_at(results, plane, 0, i),
                  vector_at(results, plane, 3, i),
                  at(6),
                  at(7) != 0,
                  static_cast<int>(at(8)),
                  at(9) != 0};
  }
  return samples;
}

std::vector<Sample> DeviceModel::sample(int material, const Direction& fixed, std::size_t count,
                                        std::uint32_t seed, bool roulette, std::uint32_t first) const {
  const cl_uint2 key{{seed, 0x766572}}; // a family of its own, apart from renders' seeds
  return run_samples("sample_model", material, fixed, count, key, cl_uint{first},
                     static_cast<cl_int>(roulette));
}

std::vector<Sample> DeviceModel::drive(int material, const Direction& fixed, const std::vector<Words>& words,
                                       bool roulette) const {
  const cl::Buffer memory =
      planes(words.size(), 4, [&](std::size_t i, std::size_t k) { return words[i][k]; });
  return run_samples("drive_model", material, fixed, words.size(), memory, static_cast<cl_int>(roulette));
}

std::vector<PairValues> DeviceModel::evaluate(int material, const std::vector<Pair>& pairs) const {
  const std::size_t plane = plane_of(pairs.size());
  const cl::Buffer memory = planes(pairs.size(), 6, [&](std::size_t i, std::size_t k) {
    return word_of(k < 3 ? pairs[i].a[static_cast<int>(k)] : pairs[i].b[static_cast<int>(k) - 3]);
  });
  const std::vector<float> results =
      program_.run("evaluate_model", pairs.size(), pair_values * plane, cl_int{material}, memory);
  std::vector<PairValues> values(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto at = [&](std::size_t k) -> double { return results[k * plane + i]; };
    values[i] = {
        vector_at(results, plane, 0, i), vector_at(results, plane, 3, i), at(6), at(7), at(8), at(9)};
  }
  return values;
}

std::vector<Rgb> DeviceModel::reflectivity(int material, const std::vector<Direction>& directions) const {
  const std::size_t plane = plane_of(directions.size());
  const cl::Buffer memory = planes(directions.size(), 3, [&](std::size_t i, std::size_t k) {
    return word_of(directions[i][static_cast<int>(k)]);
  });
  const std::vector<float> results =
      program_.run("integrate_model", directions.size(), 3 * plane, cl_int{material}, memory);
  std::vector<Rgb> values(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) values[i] = vector_at(results, plane, 0, i);
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

} // namespace phlux::measure
