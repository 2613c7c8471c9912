// The Phong module used alone: kernels/phong/example.cl, and the reflectivity without a table.
#include <cmath>
#include <numbers>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "device/kernel.h"
#include "device_under_test.h"
#include "measure/moments.h"
#include "measure/statistics.h"
#include "phong/reflectivity.h"

using namespace phlux;

namespace {

using test::kernel_files;
using test::test_device;

device::ProgramSource source(const std::string& root, const std::string& strategy, int width) {
  return {root,
          {{"WIDTH", std::to_string(width)},
           {"PHONG_TABLE_INTERVALS", std::to_string(phong::reflectivity_intervals)},
           {"PHONG_STRATEGY", "\"phong/strategies/" + strategy + ".cl\""}},
          {},
          ""};
}

template<typename T>
cl::Buffer upload(std::vector<T> values) {
  return {test_device().context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T),
          values.data()};
}

struct Plain {
  float kd, ks, exponent, cosine;
};

// Mean weight of each lane of 64 work-items.
std::vector<float> mean_weights(const device::BuiltProgram& program, int width, const Plain& model,
                                int samples) {
  constexpr std::size_t items = 64;
  std::vector<float> row, means(items * static_cast<std::size_t>(width));
  (void)phong::append_reflectivities(static_cast<double>(model.exponent), row);
  const cl::Buffer table = upload(row);
  const cl::Buffer result(test_device().context, CL_MEM_WRITE_ONLY, means.size() * sizeof(float));
  device::Kernel kernel(program, "mean_weight");
  cl_uint index = 0;
  const auto set = [&](const auto&... arguments) { (kernel.set(index++, arguments), ...); };
  set(model.kd, model.ks, model.exponent, table, model.cosine, cl_uint2{{7, 0}}, cl_int{samples}, result);
  const cl::CommandQueue& queue = test_device().queue;
  queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange, cl::NDRange(items), cl::NDRange(1));
  queue.enqueueReadBuffer(result, CL_TRUE, 0, means.size() * sizeof(float), means.data());
  return means;
}

// Two-sided p-value of the mean of independent values. For a constant: 1 if it is correct up to rounding and
// the error of the table, else 0.
double mean_p(const std::vector<float>& values, double expected) {
  constexpr double table_error = 1e-4; // relative
  measure::PowerSums sums;
  sums.centre = expected;
  for (const float value : values) sums.add(static_cast<double>(value));
  const measure::Moments moments = moments_of(sums);
  const double off = std::max(0.0, std::abs(moments.mean - expected) - table_error * expected);
  if (off == 0) return 1;
  return moments.mean_standard_error > 0 ? measure::normal_p(off / moments.mean_standard_error) : 0;
}

} // namespace

TEST_CASE("example.cl compiles with only lanes, math, lobes/lobe.h and phong") {
  const std::string text = device::expand(kernel_files(), source("phong/example.cl", "exact", 1));
  const std::regex line("#line [0-9]+ \"([^\"]+)\"");
  const std::regex allowed("(lanes|math|phong)/.*|lobes/lobe\\.h");
  std::set<std::string> files;
  for (std::sregex_iterator each(text.begin(), text.end(), line), end; each != end; ++each)
    files.insert((*each)[1]);
  CHECK(files.contains("phong/phong.cl"));
  CHECK(files.contains("lobes/lobe.h"));
  for (const std::string& file : files) {
    CAPTURE(file);
    CHECK(std::regex_match(file, allowed));
  }
}

// Together they raise a false alarm with probability 1e-4.
TEST_CASE("example.cl: the mean weight is the reflectivity") {
  const std::vector<Plain> models = {{.4f, .4f, 10, .5f}, {.4f, .05f, 50, .0872f}, {.1f, .8f, 90, .866f}};
  const std::vector<std::string> strategies = {"exact", "lobe-ks", "cosine", "fold"};
  const std::vector<int> widths = {1, 16};
  const double level = measure::sidak_limit(1e-4, models.size() * strategies.size() * widths.size());
  for (const std::string& strategy : strategies)
    for (const int width : widths) {
      const auto program =
          device::build(test_device(), kernel_files(), source("phong/example.cl", strategy, width));
      for (const Plain& m : models) {
        CAPTURE(strategy, width, m.exponent);
        const double exact =
            static_cast<double>(m.kd) +
            static_cast<double>(m.ks) *
                phong::lobe_reflectivity(static_cast<double>(m.exponent), static_cast<double>(m.cosine));
        const int samples = static_cast<int>(test::thinned(4096, 256));
        CHECK(mean_p(mean_weights(program, width, m, samples), exact) > level);
      }
    }
}

TEST_CASE("phong_reflectivity_of agrees with the closed form to the error that it states") {
  device::ProgramSource with_formula = source("phong/reflectivity.h", "exact", 1);
  with_formula.extra = R"(
__kernel void evaluate(const __global float* exponents, const __global float* cosines, __global float* values) {
  const size_t i = get_global_id(0);
  values[i] = phong_reflectivity_of(exponents[i], cosines[i]);
})";
  const auto program = device::build(test_device(), kernel_files(), with_formula);
  const int angles = static_cast<int>(test::thinned(900));
  std::vector<float> exponents, cosines;
  for (const float n : {0.f, .3f, 1.f, 1.5f, 2.f, 5.f, 10.f, 50.f, 300.f, 1e4f, 1e6f})
    for (int i = 0; i <= angles; ++i) {
      exponents.push_back(n);
      cosines.push_back(std::max(0.f, static_cast<float>(std::cos(i * std::numbers::pi / 2 / angles))));
    }
  std::vector<float> values(exponents.size());
  const cl::Buffer result(test_device().context, CL_MEM_WRITE_ONLY, values.size() * sizeof(float));
  device::Kernel kernel(program, "evaluate");
  const cl::Buffer of_exponents = upload(exponents), of_cosines = upload(cosines);
  kernel.set(0, of_exponents);
  kernel.set(1, of_cosines);
  kernel.set(2, result);
  test_device().queue.enqueueNDRangeKernel(kernel.ready(), cl::NullRange, cl::NDRange(values.size()),
                                           cl::NullRange);
  test_device().queue.enqueueReadBuffer(result, CL_TRUE, 0, values.size() * sizeof(float), values.data());
  double worst = 0, worst_below_one = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double exact =
        phong::lobe_reflectivity(static_cast<double>(exponents[i]), static_cast<double>(cosines[i]));
    double& error = exponents[i] < 1 ? worst_below_one : worst;
    error = std::max(error, std::abs(static_cast<double>(values[i]) / exact - 1));
  }
  CHECK(worst < 2e-5);
  CHECK(worst_below_one < 3e-4);
}
