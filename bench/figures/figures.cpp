#include "bench/figures/figures.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "bench/common/case.h"
#include "bench/common/report/draw.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "measure/material_program.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr double pi = std::numbers::pi;

// Parameters of all figures, from their captions in CW 197.
constexpr double diffuse = .4, specular = .05, exponent = 50, incoming_degrees = 30;
constexpr int sampled_count = 100'000, samples_of_square = 10;

constexpr double incoming_angles[] = {0, 15, 30, 45, 60, 75}; // degrees, figure 1
constexpr int squares = 25;                                   // along x and along y, figures 6 and 7

// Direction at this angle from the normal and longitude 0, so that its mirror direction is at longitude pi.
cl_float4 direction_at(double degrees) {
  const double angle = degrees * pi / 180;
  return {{static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)), 0}};
}

class FigureKernels {
public:
  explicit FigureKernels(const FiguresOptions& options)
      : program_(device::open_devices(options.devices).front(), sources::KernelFiles(options.kernel_dir),
                 {.root = "measure/figures.cl", .lanes = options.lanes}),
        seed_{{options.seed, 0}} {
    program_.set_materials({material_of({diffuse, specular, exponent, incoming_degrees})});
  }

  std::vector<float> pairs(const std::vector<float>& fixed, const std::vector<float>& generated) {
    const std::size_t count = fixed.size() / 3;
    return program_.run("evaluate_pairs", count, count, program_.upload(fixed), program_.upload(generated),
                        static_cast<cl_int>(count));
  }
  std::vector<float> parameters(int space, const std::vector<float>& values) {
    const std::size_t count = values.size() / 2;
    return program_.run("evaluate_parameters", count, 5 * count, direction_at(incoming_degrees),
                        cl_int{space}, program_.upload(values), static_cast<cl_int>(count));
  }
  std::vector<float> samples(int count) {
    return program_.run("sample_squares", static_cast<std::size_t>(count),
                        3 * static_cast<std::size_t>(count), direction_at(incoming_degrees), seed_,
                        cl_int{count});
  }
  std::vector<float> evaluated(int side, int count) {
    const auto all = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    return program_.run("evaluate_squares", all, all, direction_at(incoming_degrees), seed_, cl_int{side},
                        cl_int{count});
  }

private:
  measure::MaterialProgram program_;
  cl_uint2 seed_;
};

// ---- Figure 1: f_r in the plane of incidence

void write_polar(FigureKernels& kernels, const std::filesystem::path& folder) {
  constexpr int half = 360; // steps of 1/4 degree on each side of the normal
  std::vector<float> fixed, generated;
  std::vector<std::pair<double, double>> degrees;
  for (const double incoming : incoming_angles)
    for (int i = -half; i <= half; ++i) {
      const double outgoing = 90.0 * i / half; // negative on the side of the light
      const cl_float4 from = direction_at(-incoming), to = direction_at(outgoing);
      fixed.insert(fixed.end(), from.s, from.s + 3);
      generated.insert(generated.end(), to.s, to.s + 3);
      degrees.emplace_back(incoming, outgoing);
    }
  const std::vector<float> values = kernels.pairs(fixed, generated);
  CsvFile table(folder, "figure-1.csv", "incoming_degrees,outgoing_degrees,f_r");
  for (std::size_t i = 0; i < values.size(); ++i)
    table.line(fmt::format("{},{},{:.7g}", degrees[i].first, degrees[i].second, values[i]));
}

// ---- Figures 2 to 5: parameters of the hemisphere

struct Space {
  int figure, number;         // number: SPACE_... of kernels/measure/figures.cl
  double first[2], second[2]; // ranges of the parameters in CW 197
  bool unit;                  // the kernel takes parameters scaled to [0, 1]
};
constexpr Space spaces[] = {{2, 0, {0, pi / 2}, {0, 2 * pi}, true},
                            {3, 1, {0, 1}, {0, 2 * pi}, true},
                            {4, 2, {0, 1}, {0, 1}, true},
                            {5, 3, {-1, 1}, {-1, 1}, false}};
constexpr int first_steps = 48, second_steps = 96; // of the grid; (x, y) has second_steps for both

void write_space(FigureKernels& kernels, const std::filesystem::path& folder, const Space& space) {
  const int rows = space.unit ? first_steps : second_steps;
  std::vector<double> firsts, seconds;
  std::vector<float> parameters;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= second_steps; ++j) {
      const double u = static_cast<double>(i) / rows, v = static_cast<double>(j) / second_steps;
      firsts.push_back(std::lerp(space.first[0], space.first[1], u));
      seconds.push_back(std::lerp(space.second[0], space.second[1], v));
      parameters.push_back(static_cast<float>(space.unit ? u : firsts.back()));
      parameters.push_back(static_cast<float>(space.unit ? v : seconds.back()));
    }
  const std::vector<float> values = kernels.parameters(space.number, parameters);
  CsvFile table(folder, fmt::format("figure-{}.csv", space.figure),
                "first,second,direction_x,direction_y,direction_z,f_r,integrand");
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const float* v = &values[5 * i];
    const bool outside = !space.unit && std::hypot(firsts[i], seconds[i]) > 1 + 1e-9;
    if (!outside)
      table.line(fmt::format("{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}", firsts[i], seconds[i], v[0],
                             v[1], v[2], v[3], v[4]));
  }
}

// ---- Figures 6 and 7: partial reflectivities

double write_squares(const std::filesystem::path& folder, int figure, const std::vector<double>& values) {
  CsvFile table(folder, fmt::format("figure-{}.csv", figure), "x,y,partial_reflectivity");
  double sum = 0;
  for (int row = 0; row < squares; ++row)
    for (int column = 0; column < squares; ++column) {
      const double value = values[static_cast<std::size_t>(row * squares + column)];
      const auto centre = [](int i) { return -1 + 2 * (i + 0.5) / squares; };
      table.line(fmt::format("{:.6g},{:.6g},{:.7g}", centre(column), centre(row), value));
      sum += value;
    }
  return sum;
}

std::vector<double> sampled_squares(FigureKernels& kernels) {
  const std::vector<float> samples = kernels.samples(sampled_count);
  std::vector<double> values(static_cast<std::size_t>(squares) * squares, 0.0);
  const auto index = [](float coordinate) {
    return std::min(squares - 1, static_cast<int>((static_cast<double>(coordinate) + 1) / 2 * squares));
  };
  for (std::size_t i = 0; i < samples.size(); i += 3)
    if (samples[i + 2] > 0)
      values[static_cast<std::size_t>(index(samples[i + 1]) * squares + index(samples[i]))] +=
          static_cast<double>(samples[i + 2]) / sampled_count;
  return values;
}

} // namespace

FigureSums write_figure_tables(const FiguresOptions& options) {
  make_folder(options.folder);
  FigureKernels kernels(options);
  write_polar(kernels, options.folder);
  for (const Space& space : spaces) write_space(kernels, options.folder, space);
  const std::vector<float> evaluated = kernels.evaluated(squares, samples_of_square);
  FigureSums sums;
  sums.sampled = write_squares(options.folder, 6, sampled_squares(kernels));
  sums.evaluated = write_squares(options.folder, 7, {evaluated.begin(), evaluated.end()});
  sums.exact = exact_reflectivity({diffuse, specular, exponent, incoming_degrees});
  return sums;
}

void make_figures(const FiguresOptions& options) {
  const FigureSums sums = write_figure_tables(options);
  say("reflectivity {:.5f}; figure 6 sums to {:.5f}, figure 7 to {:.5f}\n", sums.exact, sums.sampled,
      sums.evaluated);
  const device::DeviceInfo device = device::open_devices(options.devices).front().info;
  write_provenance(options.folder, "figures",
                   {"phlux bench figures", device, options.lanes_on(device), "nothing is timed",
                    std::to_string(options.seed)});
  draw_charts(options.folder, "figures");
  say("{}\n", (options.folder / "figure-{1..7}.{csv,svg,png}").string());
}

} // namespace phlux::bench
