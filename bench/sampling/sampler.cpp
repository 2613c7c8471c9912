#include "bench/sampling/sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <fmt/format.h>

#include "bench/common/methods/ranking.h"
#include "bench/common/processor_time.h"
#include "bench/sampling/quadrature.h"
#include "clock.h"

namespace phlux::bench {
namespace {

// Sums of this many float32 terms have a rounding error of a few 1e-6 of their standard deviation.
constexpr std::uint64_t most_block_samples = 256;
constexpr int fixed_directions = 16; // the size of a block is a multiple of this
constexpr int powers = 4, counters = 3;

// Directions at this angle and equidistant longitudes.
std::vector<std::array<double, 3>> directions_at(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  std::vector<std::array<double, 3>> directions;
  for (int i = 0; i < fixed_directions; ++i) {
    const double longitude = 2 * std::numbers::pi * (i + 0.25) / fixed_directions;
    directions.push_back(
        {std::sin(angle) * std::cos(longitude), std::sin(angle) * std::sin(longitude), std::cos(angle)});
  }
  return directions;
}

// The same in every lane, in the layout of the kernel.
std::vector<float> in_lanes(const std::vector<std::array<double, 3>>& directions, int lanes) {
  std::vector<float> values;
  for (const auto& direction : directions)
    for (const double component : direction)
      values.insert(values.end(), static_cast<std::size_t>(lanes), static_cast<float>(component));
  return values;
}

measure::MaterialProgram::Source source_of(const std::string& strategy, int lanes,
                                           const lobes::ModelPointer& model) {
  const bool is_phong = model->name == "phong"; // a program for another model has no code of strategies
  std::string sampled_by = "SAMPLED_BY_MODEL";
  if (!is_phong && strategy == "cosine") sampled_by = "SAMPLED_BY_COSINE";
  if (!is_phong && strategy == "uniform") sampled_by = "SAMPLED_BY_HEMISPHERE";
  return {"measure/sampling.cl",
          {model},
          is_phong ? strategy : "exact",
          lanes,
          {{"FIXED_DIRECTIONS", std::to_string(fixed_directions)}, {"SAMPLED_BY", sampled_by}}};
}

double seconds_of(const cl::Event& event) {
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

} // namespace

double rejection_proposals(const Case& one) {
  return (one.diffuse + one.specular * (one.exponent + 2) / 2) / exact_reflectivity(one);
}

// In the coordinates of kernels/phong/sampling.md the horizon is at longitude psi = pi / 2 - theta, and the
// density of the lobe is a product of powers of cos(beta) and cos(psi).
double printed_loss(const Case& one) {
  const double sine = std::sin(one.degrees * std::numbers::pi / 180);
  return boost::math::ibeta((one.exponent + 1) / 2, 0.5, sine * sine) / 2;
}

double printed_density_at_horizon(const Case& one) {
  const double n = one.exponent, sine = std::sin(one.degrees * std::numbers::pi / 180);
  const double latitudes = std::sqrt(std::numbers::pi) * boost::math::tgamma_delta_ratio((n + 1) / 2, 0.5);
  return (n + 1) / (2 * std::numbers::pi) * std::pow(sine, n) * latitudes;
}

bool has_roulette(const std::string& strategy) {
  return strategy != "uniform" && strategy != "theta-phi" && strategy != "cosine" && strategy != "disk";
}

std::vector<std::string> strategies_of_model(const scene::Model& model) {
  std::vector<std::string> names = {model.name, "cosine", "uniform"};
  if (model.name == "anisotropicphong" && model.text.empty()) names.emplace_back(exact_split);
  return names;
}

void Sampler::Run::add(const Run& other) {
  sums.d += other.sums.d;
  sums.d2 += other.sums.d2;
  sums.d3 += other.sums.d3;
  sums.d4 += other.sums.d4;
  sums.count += other.sums.count;
  sums.centre = other.sums.centre;
  rays += other.rays;
  draws += other.draws;
  defects += other.defects;
  seconds += other.seconds;
  wall_seconds += other.wall_seconds;
}

std::string Sampler::kernels_fingerprint(const sources::KernelFiles& files,
                                         const std::vector<std::string>& strategies, int lanes,
                                         const lobes::ModelPointer& model) {
  std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
  for (const std::string& strategy : strategies)
    for (const char c :
         device::significant(device::expand(files, source_of(strategy, lanes, model).program())))
      hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

Sampler::Sampler(const device::Device& device, const sources::KernelFiles& files, const std::string& strategy,
                 int lanes, const lobes::ModelPointer& model)
    : program_(device, files, source_of(strategy, lanes, model)), strategy_(strategy),
      items_(device.info.compute_units * (device.info.type == "cpu" ? 4 : 1024)),
      local_(device.info.type == "cpu" ? 1 : 64), kernel_(program_.program(), "sample_moments") {}

Sampler::Blocks Sampler::blocks(std::uint64_t samples) const {
  const auto rounded_up = [](std::uint64_t a, std::uint64_t b) {
    return std::max<std::uint64_t>(1, (a + b - 1) / b);
  };
  const std::uint64_t lane = rounded_up(samples, items_ * static_cast<std::uint64_t>(program_.lanes()));
  const std::uint64_t size =
      std::min(most_block_samples, rounded_up(lane, fixed_directions) * fixed_directions);
  return {rounded_up(lane, size), size};
}

std::uint32_t Sampler::samples_per_lane(std::uint64_t samples) const {
  const auto [count, size] = blocks(samples);
  return static_cast<std::uint32_t>(count * size);
}

// The words diffuse_max and specular_max, of which part_shares() of kernels/lobes/anisotropicphong.cl
// estimates the reflectivities D and S of the parts,
//   S = specular_max + (1 - specular_max) (1 - cos)^5,  D = diffuse_max (1 - S),
// so that it finds those that the model has in the directions of the case, as means over longitudes and
// channels.
std::vector<float> Sampler::words_of_exact_split(const Case& one) {
  scene::Material lobe = material_of(one);
  lobe.value("diffuse_reflectance") = scene::Rgb(0.0);
  Case of_lobe = one;
  of_lobe.given = std::make_shared<const scene::Material>(lobe);
  const double specular = reflectivity_of(of_lobe), diffuse = reflectivity_of(one) - specular;
  const double grazing = std::pow(1 - std::cos(one.degrees * std::numbers::pi / 180), 5);
  return {static_cast<float>(diffuse / (1 - specular)),
          static_cast<float>((specular - grazing) / (1 - grazing))};
}

void Sampler::prepare(const Case& one) {
  if (one != prepared_ && strategy_ == exact_split) derived_ = words_of_exact_split(one);
  program_.set_materials({material_of(one)}, derived_);
  if (one == prepared_) return;
  directions_ = program_.upload(in_lanes(directions_at(one.degrees), program_.lanes()));
  prepared_ = one;
}

double Sampler::reflectivity_of(const Case& one) {
  program_.set_materials({material_of(one)});
  double sum = 0;
  for (const auto& [x, y, z] : directions_at(one.degrees)) {
    const cl_float4 fixed{{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0}};
    const auto evaluate = [&](const std::vector<float>& directions) {
      const std::size_t count = directions.size() / 3;
      return program_.run("evaluate_directions", count, count, fixed, program_.upload(directions),
                          static_cast<cl_int>(count));
    };
    sum += hemisphere_integral(evaluate, {{x, y, z}, {-x, -y, z}});
  }
  return sum / fixed_directions;
}

Sampler::Run Sampler::run(const Case& one, std::uint64_t samples, cl_uint2 seed, std::uint32_t first) {
  return run({one, Light::constant, has_roulette(strategy_), exact_reflectivity(one), seed}, samples, first);
}

Sampler::Run Sampler::run(const Subject& subject, std::uint64_t samples, std::uint32_t first) try {
  prepare(subject.one);
  const auto [block_count, block_samples] = blocks(samples);
  const auto centre = static_cast<float>(subject.reflected);
  const auto lanes = static_cast<std::size_t>(program_.lanes());
  const device::Device& device = program_.device();
  std::vector<float> sums(items_ * lanes * block_count * powers);
  std::vector<cl_uint> counts(items_ * counters);
  const cl::Buffer device_sums(device.context, CL_MEM_WRITE_ONLY, sums.size() * sizeof(float));
  const cl::Buffer device_counts(device.context, CL_MEM_WRITE_ONLY, counts.size() * sizeof(cl_uint));
  cl_uint index = program_.bind_materials(kernel_);
  const auto set = [&](const auto&... arguments) { (kernel_.setArg(index++, arguments), ...); };
  set(directions_, subject.seed, cl_uint{first}, static_cast<cl_int>(block_count),
      static_cast<cl_int>(block_samples), static_cast<cl_int>(subject.roulette),
      static_cast<cl_int>(subject.light), cl_float{centre}, device_sums, device_counts);
  cl::Event done;
  const Clock::time_point begin = Clock::now();
  const double begin_processor = processor_seconds();
  device.queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(items_), cl::NDRange(local_), nullptr,
                                    &done);
  done.wait();
  const double wall_seconds = seconds_since(begin), processor = processor_seconds() - begin_processor;
  device.queue.enqueueReadBuffer(device_sums, CL_TRUE, 0, sums.size() * sizeof(float), sums.data());
  device.queue.enqueueReadBuffer(device_counts, CL_TRUE, 0, counts.size() * sizeof(cl_uint), counts.data());

  Run run;
  double* const totals[powers] = {&run.sums.d, &run.sums.d2, &run.sums.d3, &run.sums.d4};
  for (std::size_t i = 0; i < sums.size(); ++i) *totals[i / lanes % powers] += static_cast<double>(sums[i]);
  for (std::size_t item = 0; item < items_; ++item) {
    run.rays += counts[item * counters];
    run.draws += counts[item * counters + 1];
    run.defects += counts[item * counters + 2];
  }
  run.sums.count = items_ * lanes * block_count * block_samples;
  run.sums.centre = static_cast<double>(centre);
  run.seconds = clock_of(device.info) == CostClock::processor ? processor : seconds_of(done);
  run.wall_seconds = wall_seconds;
  return run;
} catch (const cl::Error& error) {
  program_.fail(error);
}

} // namespace phlux::bench
