#include "bench/remedies/remedies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/methods/timed_render.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/remedies/many_lights_scene.h"
#include "bench/stability/stability_scene.h"
#include "device/device.h"
#include "measure/moments.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr int rounds = 8, quick_rounds = 4;
constexpr double round_seconds = 0.5, quick_round_seconds = 0.15;
constexpr int side = 48, quick_side = 32;

const std::string light_selection = "light-selection", connections = "connections", exact_lobe = "exact-lobe";
const std::string columns =
    "remedy,place,integrator,connect_or_weights,variance_before,variance_before_standard_error,variance_"
    "after,"
    "variance_after_standard_error,ns_per_sample_before,ns_per_sample_after,rays_per_sample_before,"
    "rays_per_sample_after,gain,gain_standard_error,rounds,image,seed,device";

struct Cell {
  double exponent, light_radius;
};

std::vector<Cell> cells(bool quick) {
  if (quick) return {{10, .1}, {1000, .01}};
  return {{1, .3}, {1, .01}, {30, .1}, {1000, .3}, {1000, .01}, {1e5, .03}};
}

std::vector<int> light_counts(bool quick) {
  if (quick) return {16, 1024};
  return {8, 64, 1024, 16384, 262144};
}

const Method path_light{"path", "exact", "light"}, path_mis{"path", "exact", "mis"},
    bidir{"bidir", "exact", "balance"};

RemedyCase new_case(const RemediesOptions& options, const std::string& remedy, const std::string& place,
                    const scene::Scene& scene, const Method& method) {
  RemedyCase result{remedy, place, scene, method, settings_of(method, scene.defaults), {}};
  options.apply_to(result.before);
  result.before.seed = options.seed;
  result.after = result.before;
  return result;
}

void add_light_selection(const RemediesOptions& options, int size, std::vector<RemedyCase>& cases) {
  for (const int lights : light_counts(options.quick))
    for (const Method& method : {path_light, path_mis, bidir}) {
      RemedyCase one = new_case(options, light_selection, fmt::format("{} lights", lights),
                                many_lights_scene(lights, size), method);
      one.before.light_selection = render::LightSelection::power;
      cases.push_back(std::move(one));
    }
}

void add_cells(const RemediesOptions& options, int size, const std::string& remedy,
               const std::vector<Method>& methods, const std::function<void(render::Settings&)>& without,
               std::vector<RemedyCase>& cases) {
  for (const auto& [exponent, radius] : cells(options.quick))
    for (const Method& method : methods) {
      RemedyCase one = new_case(options, remedy, fmt::format("n {:g} light radius {:g}", exponent, radius),
                                stability_scene(exponent, radius, size), method);
      without(one.before);
      cases.push_back(std::move(one));
    }
}

struct Rounds { // renders before, or after
  std::vector<ImageEstimate> images;
  std::vector<double> seconds, rays;

  void add(const TimedRender& render, bool processor_time) {
    images.push_back(render.last.image);
    seconds.push_back(processor_time ? render.processor_seconds_per_sample : render.seconds_per_sample);
    rays.push_back(static_cast<double>(render.statistics.rays + render.statistics.shadow_rays) /
                   render.paths);
  }
  [[nodiscard]] Efficiency efficiency(const Reference& reference) const {
    return {mean_of(variances_per_sample(images, reference)), measure::median(seconds),
            measure::median(rays)};
  }
};

struct Measurement {
  Efficiency before, after;
};

Measurement measure(const RemedyCase& one, const RemediesOptions& options, bool processor_time) {
  Rounds before, after;
  const double seconds = options.quick ? quick_round_seconds : round_seconds;
  MethodRenderer without(one.scene, one.before), with(one.scene, one.after);
  for (int round = 0; round < (options.quick ? quick_rounds : rounds); ++round) {
    const std::uint64_t seed = one.before.seed + static_cast<std::uint64_t>(round);
    before.add(without.render_for(seed, seconds, {}, options.interrupted), processor_time);
    after.add(with.render_for(seed, seconds, {}, options.interrupted), processor_time);
  }
  std::vector<ImageEstimate> all = before.images;
  all.insert(all.end(), after.images.begin(), after.images.end());
  const Reference reference = pooled_reference(all, static_cast<std::size_t>(one.scene.camera.width));
  return {before.efficiency(reference), after.efficiency(reference)};
}

std::string row_of(const RemedyCase& one, const Measurement& m, const RemediesOptions& options,
                   const device::DeviceInfo& device) {
  const Estimate gain = gain_of(m.before, m.after);
  std::vector<std::string> row = {one.remedy, one.place, one.method.integrator, one.method.variant};
  for (const double value :
       {m.before.variance.value, m.before.variance.standard_error, m.after.variance.value,
        m.after.variance.standard_error, 1e9 * m.before.seconds_per_sample, 1e9 * m.after.seconds_per_sample,
        m.before.rays_per_sample, m.after.rays_per_sample, gain.value, gain.standard_error})
    row.push_back(fmt::format("{:.4g}", value));
  row.push_back(fmt::format("{}", options.quick ? quick_rounds : rounds));
  row.push_back(fmt::format("{}x{}", one.scene.camera.width, one.scene.camera.height));
  row.push_back(fmt::format("{}", options.seed));
  row.push_back(csv_value(device.name));
  return fmt::format("{}", fmt::join(row, ","));
}

std::string command_of(const RemediesOptions& options) {
  std::string command = "phlux bench remedies";
  if (options.quick) command += " --quick";
  for (const std::string& remedy : options.remedies) command += " --remedy " + remedy;
  return fmt::format("{} --seed {}", command, options.seed);
}

} // namespace

const std::vector<std::string>& remedy_names() {
  static const std::vector<std::string> names = {light_selection, connections, exact_lobe};
  return names;
}

std::vector<RemedyCase> remedy_cases(const RemediesOptions& options) {
  const int size = options.quick ? quick_side : side;
  std::vector<RemedyCase> cases;
  add_light_selection(options, size, cases);
  add_cells(
      options, size, connections, {bidir}, [](render::Settings& s) { s.connections = 0; }, cases);
  add_cells(
      options, size, exact_lobe, {path_mis, bidir}, [](render::Settings& s) { s.strategy = "lobe-ks"; },
      cases);
  if (!options.remedies.empty())
    std::erase_if(
        cases, [&](const RemedyCase& one) { return std::ranges::count(options.remedies, one.remedy) == 0; });
  return cases;
}

Estimate gain_of(const Efficiency& before, const Efficiency& after) {
  const auto relative = [](const Estimate& f) { return f.standard_error / f.value; };
  const double gain =
      before.variance.value * before.seconds_per_sample / (after.variance.value * after.seconds_per_sample);
  return {gain, gain * std::hypot(relative(before.variance), relative(after.variance))};
}

bool measure_remedies(const RemediesOptions& options) try {
  const device::DeviceInfo device = device::open_devices(options.devices).front().info;
  CsvFile table(options.folder, "remedies.csv", columns);
  StatusLine status;
  const std::vector<RemedyCase> cases = remedy_cases(options);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const RemedyCase& one = cases[i];
    status.show(
        fmt::format("{} of {}: {}, {}, {}", i + 1, cases.size(), one.remedy, one.place, one.method.name()));
    const Measurement m = measure(one, options, device.type == "cpu");
    const Estimate gain = gain_of(m.before, m.after);
    status.clear();
    table.line(row_of(one, m, options, device));
    say("{:<20} {:<24} {:<14} {:>8.3g} +- {:.2g} times as efficient; {:.3g} rays per sample, {:.3g} before\n",
        one.remedy, one.place, one.method.name(), gain.value, gain.standard_error, m.after.rays_per_sample,
        m.before.rays_per_sample);
  }
  say("{}\n", table.path().string());
  write_provenance(
      options.folder, "remedies",
      {command_of(options), device, options.lanes_on(device), "kernels are built before anything is timed",
       fmt::format("{} to {}", options.seed,
                   options.seed + static_cast<std::uint64_t>((options.quick ? quick_rounds : rounds) - 1))});
  draw_charts(options.folder, "remedies");
  return true;
} catch (const Interrupted&) {
  say("interrupted: {} contains the finished rows\n", (options.folder / "remedies.csv").string());
  return false;
}

} // namespace phlux::bench
