#include "bench/arithmetic/arithmetic.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "errors.h"
#include "measure/moments.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int rounds = 25;
// Inputs per lane of a work item in timings: few enough for the first-level cache.
constexpr std::size_t elements_of_lane = 8;

cl::Program build(const device::Device& device, const sources::KernelFiles& files, int lanes, bool native) {
  std::map<std::string, std::string> defines = {{"WIDTH", std::to_string(lanes)}};
  if (native) defines["PHLUX_NATIVE"] = "1";
  return device::build(device, files, {"measure/arithmetic.cl", defines, {}, {}}).program;
}

double unit_in_last_place(double value) {
  return std::ldexp(1.0, std::max(std::ilogb(value), -126) - 23);
}

std::size_t work_items(const device::Device& device) {
  return device.info.compute_units * (device.info.type == "cpu" ? 4 : 1024);
}

// The kernel with the same loop and no formula.
std::string empty_kernel(const FormulaGroup& group) {
  return fmt::format("empty_{}_{}", group.inputs, group.outputs);
}

// Inputs of the elements as the kernels read them, one plane per input, and in the order of drawing.
struct Elements {
  std::vector<float> planes;
  std::vector<double> drawn;
};

Elements draw(const FormulaGroup& group, double exponent, std::size_t count, std::uint32_t seed) {
  FormulaGroup::Random random(seed);
  const std::size_t size = group.inputs + group.hidden;
  Elements elements{std::vector<float>(count * group.inputs), std::vector<double>(count * size)};
  for (std::size_t i = 0; i < count; ++i) {
    double* const one = &elements.drawn[i * size];
    group.draw(random, exponent, one);
    for (std::size_t k = 0; k < group.inputs; ++k) {
      elements.planes[k * count + i] = static_cast<float>(one[k]);
      one[k] = static_cast<double>(elements.planes[k * count + i]);
    }
  }
  return elements;
}

} // namespace

ArithmeticKernels::ArithmeticKernels(const device::Device& device, const sources::KernelFiles& files,
                                     int lanes)
    : device_(device), lanes_(lanes) {
  try {
    program_ = build(device, files, lanes, true);
  } catch (const DeviceError& error) {
    spdlog::info("native_ functions are left out: {}", error.what());
    native_ = false;
    program_ = build(device, files, lanes, false);
  }
}

double ArithmeticKernels::run(const std::string& name, const FormulaGroup& group,
                              const std::vector<float>& inputs, double exponent, int repeats,
                              std::vector<float>& outputs) const try {
  const std::size_t count = inputs.size() / group.inputs;
  outputs.resize(count * group.outputs);
  const cl::Buffer in(device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, inputs.size() * sizeof(float),
                      const_cast<float*>(inputs.data()));
  const cl::Buffer out(device_.context, CL_MEM_WRITE_ONLY, outputs.size() * sizeof(float));
  cl::Kernel kernel(program_, name.c_str());
  cl_uint index = 0;
  const auto set = [&](const auto&... arguments) { (kernel.setArg(index++, arguments), ...); };
  set(in, static_cast<cl_int>(count), static_cast<cl_float>(exponent), static_cast<cl_int>(repeats),
      cl_float{0}, out);
  cl::Event done;
  device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(work_items(device_)),
                                     cl::NDRange(device_.info.type == "cpu" ? 1 : 64), nullptr, &done);
  device_.queue.enqueueReadBuffer(out, CL_TRUE, 0, outputs.size() * sizeof(float), outputs.data());
  return 1e-9 * static_cast<double>(done.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    done.getProfilingInfo<CL_PROFILING_COMMAND_START>());
} catch (const cl::Error& error) {
  throw DeviceError(fmt::format("{}: {} in {}", device_.info.name, device::describe(error), name));
}

FormulaErrors ArithmeticKernels::errors(const FormulaGroup& group, const Formula& formula, double exponent,
                                        std::size_t values, std::uint32_t seed) const {
  const auto lanes = static_cast<std::size_t>(lanes_);
  const std::size_t count = (values + lanes - 1) / lanes * lanes;
  const Elements elements = draw(group, exponent, count, seed);
  std::vector<float> planes, outputs(group.outputs);
  (void)run(formula.kernel, group, elements.planes, exponent, 1, planes);
  FormulaErrors errors;
  double relative2 = 0, ulp2 = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < group.outputs; ++k) outputs[k] = planes[k * count + i];
    const auto error =
        group.error(&elements.drawn[i * (group.inputs + group.hidden)], exponent, outputs.data());
    if (error.failed || !std::isfinite(error.absolute)) {
      ++errors.failed;
      continue;
    }
    const double relative = error.absolute / error.scale,
                 ulp = error.absolute / unit_in_last_place(error.scale);
    errors.largest_relative = std::max(errors.largest_relative, relative);
    errors.largest_ulp = std::max(errors.largest_ulp, ulp);
    relative2 += relative * relative;
    ulp2 += ulp * ulp;
    ++errors.values;
  }
  const auto sound = static_cast<double>(std::max<std::size_t>(1, errors.values));
  errors.rms_relative = std::sqrt(relative2 / sound);
  errors.rms_ulp = std::sqrt(ulp2 / sound);
  errors.values = count;
  return errors;
}

double ArithmeticKernels::nanoseconds(const FormulaGroup& group, const std::string& kernel, double exponent,
                                      std::size_t values) const {
  const std::size_t count = work_items(device_) * static_cast<std::size_t>(lanes_) * elements_of_lane;
  const int repeats = static_cast<int>(std::max<std::size_t>(1, values / count));
  std::vector<float> outputs;
  const double seconds =
      run(kernel, group, draw(group, exponent, count, 1).planes, exponent, repeats, outputs);
  return 1e9 * seconds / static_cast<double>(count) / repeats;
}

const std::vector<std::string>& arithmetic_columns() {
  static const std::vector<std::string> columns = {
      "group",        "formula",     "n",       "used",         "values",   "failed",  "largest_relative",
      "rms_relative", "largest_ulp", "rms_ulp", "ns_per_value", "ns_least", "ns_most", "ns_loop",
      "rounds",       "device",      "width"};
  return columns;
}

namespace {

struct Timings {
  std::vector<double> loop;                  // of each round, nanoseconds
  std::vector<std::vector<double>> formulas; // minus the loop in the same round
};

// All launches take about the same time, so that other load on the machine affects all formulas alike.
Timings time_in_turns(const ArithmeticKernels& kernels, const FormulaGroup& group,
                      const std::vector<const Formula*>& formulas, double exponent, bool quick) {
  const double launch = quick ? 2e5 : 1e6; // nanoseconds
  constexpr std::size_t trial = 1 << 16;
  std::vector<std::string> names = {empty_kernel(group)};
  for (const Formula* formula : formulas) names.push_back(formula->kernel);
  std::vector<std::size_t> values;
  for (const std::string& name : names) {
    (void)kernels.nanoseconds(group, name, exponent, 1); // drivers compile at the first launch
    const double about = kernels.nanoseconds(group, name, exponent, trial);
    values.push_back(static_cast<std::size_t>(launch / std::max(about, 1e-3)));
  }
  Timings timings{{}, std::vector<std::vector<double>>(formulas.size())};
  for (int round = 0; round < rounds; ++round) {
    timings.loop.push_back(kernels.nanoseconds(group, names[0], exponent, values[0]));
    for (std::size_t i = 0; i < formulas.size(); ++i)
      timings.formulas[i].push_back(kernels.nanoseconds(group, names[i + 1], exponent, values[i + 1]) -
                                    timings.loop.back());
  }
  return timings;
}

} // namespace

void write_arithmetic_table(const ArithmeticOptions& options) {
  CsvFile table(options.folder, "arithmetic.csv", fmt::format("{}", fmt::join(arithmetic_columns(), ",")));
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes_on(device.info);
  const ArithmeticKernels kernels(device, sources::KernelFiles(options.kernel_dir), lanes);
  const std::size_t values = std::size_t{1} << (options.quick ? 15 : 18);
  StatusLine status;
  for (const FormulaGroup& group : formula_groups())
    for (const double exponent : group.exponents) {
      status.show(fmt::format("{}, n = {:g}", group.what, exponent));
      std::vector<const Formula*> formulas;
      for (const Formula& formula : group.formulas)
        if (kernels.has(formula)) formulas.push_back(&formula);
      const Timings timings = time_in_turns(kernels, group, formulas, exponent, options.quick);
      for (std::size_t i = 0; i < formulas.size(); ++i) {
        const FormulaErrors e = kernels.errors(group, *formulas[i], exponent, values, options.seed);
        const auto [least, most] = std::ranges::minmax(timings.formulas[i]);
        table.line(fmt::format(
            "{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{},{},{}", group.name,
            formulas[i]->name, exponent, formulas[i]->used ? 1 : 0, e.values, e.failed, e.largest_relative,
            e.rms_relative, e.largest_ulp, e.rms_ulp, measure::median(timings.formulas[i]), least, most,
            measure::median(timings.loop), rounds, csv_value(device.info.name), lanes));
      }
    }
}

void measure_arithmetic(const ArithmeticOptions& options) {
  write_arithmetic_table(options);
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes_on(device.info);
  say("{}\n", (options.folder / "arithmetic.csv").string());
  write_provenance(options.folder, "arithmetic",
                   {fmt::format("phlux bench arithmetic{} --width {} --seed {}",
                                options.quick ? " --quick" : "", lanes, options.seed),
                    device.info, lanes, "each kernel is run once before it is timed",
                    std::to_string(options.seed)});
  draw_charts(options.folder, "arithmetic");
}

} // namespace phlux::bench
