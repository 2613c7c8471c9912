#include "bench/techniques/techniques.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/enumeration.h"
#include "bench/common/methods/method.h"
#include "bench/common/methods/result_table.h"
#include "bench/common/methods/timed_render.h"
#include "bench/common/report/draw.h"
#include "bench/common/status_line.h"
#include "bench/common/tables/csv.h"
#include "bench/common/tables/provenance.h"
#include "bench/scenes/scene_files.h"
#include "files/output.h"
#include "measure/statistics.h"
#include "terminal.h"

namespace phlux::bench {
namespace {

constexpr double false_alarm_rate = 0.05;

const std::string columns =
    "scene,integrator,connect_or_weights,light_vertices,eye_vertices,edges,light_share,light_share_standard_"
    "error,variance_share,variance_share_standard_error,variance,variance_standard_error,variance_alone,"
    "variance_alone_standard_error,rays_per_sample,ray_share,rounds,samples_per_pixel,image,seed,device";

Method method_of(const TechniquesOptions& options) {
  return {options.integrator, render::Settings().strategy,
          options.integrator == "bidir" ? options.weights : "-"};
}

ImageEstimate image_of(const std::vector<std::array<double, 3>>& radiance, double samples) {
  ImageEstimate image;
  for (const std::array<double, 3>& pixel : radiance)
    image.radiance.insert(image.radiance.end(), pixel.begin(), pixel.end());
  image.samples.assign(radiance.size(), samples);
  return image;
}

ImageEstimate black_like(const ImageEstimate& image) {
  return {std::vector<double>(image.radiance.size()), image.samples};
}

// Adds one round. A technique that had no contribution in an earlier round, or has none in this one, was
// black.
void add_round(TechniqueRounds& rounds, CountedRender render) {
  const auto paths = static_cast<double>(render.statistics.paths);
  const ImageEstimate image = estimate_of(render.film);
  const std::size_t before = rounds.images.size();
  ImageEstimate longer = image;
  for (const auto& [technique, sums] : render.film.techniques()->sums()) {
    TechniqueRounds::Contributions& mine = rounds.techniques[technique];
    mine.weighted.resize(before, black_like(image));
    mine.unweighted.resize(before, black_like(image));
    mine.weighted.push_back(image_of(render.film.technique_image(sums.weighted), image.samples[0]));
    mine.unweighted.push_back(image_of(render.film.technique_image(sums.unweighted), image.samples[0]));
    if (technique.light_vertices > 0) mine.rays += static_cast<double>(sums.contributions) / paths;
    for (std::size_t i = 0; i < longer.radiance.size(); ++i)
      longer.radiance[i] -= mine.weighted.back().radiance[i];
  }
  TechniqueRounds::Contributions& rest = rounds.techniques[longer_paths];
  rest.weighted.push_back(longer);
  rest.unweighted.push_back(longer);
  rest.rays += static_cast<double>(render.film.techniques()->left_out()) / paths;
  for (auto& [technique, mine] : rounds.techniques) {
    mine.weighted.resize(before + 1, black_like(image));
    mine.unweighted.resize(before + 1, black_like(image));
  }
  rounds.images.push_back(image);
  rounds.rays += render.rays_per_sample();
}

TechniqueRounds render_rounds(const scene::Scene& scene, const TechniquesOptions& options,
                              const std::function<void(int round)>& report) {
  render::Settings settings = settings_of(method_of(options), scene.defaults);
  settings.techniques = true;
  options.apply_to(settings);
  MethodRenderer renderer(scene, settings);
  TechniqueRounds rounds;
  const int count = options.rounds();
  for (int round = 0; round < count; ++round) {
    report(round);
    add_round(rounds, renderer.render_samples(options.seed + static_cast<std::uint64_t>(round),
                                              options.round_samples(), options.interrupted));
  }
  for (auto& [technique, mine] : rounds.techniques) mine.rays /= count;
  rounds.rays /= count;
  return rounds;
}

std::vector<std::string> values_of(const TechniqueShare& share) {
  const bool longer = share.technique == longer_paths;
  std::vector<std::string> row;
  for (const int number :
       {share.technique.light_vertices, share.technique.eye_vertices, share.technique.edges()})
    row.push_back(longer ? "" : fmt::format("{}", number));
  for (const Estimate& estimate : {share.light, share.variance_share, share.variance, share.variance_alone}) {
    row.push_back(number_text(estimate.value));
    row.push_back(number_text(estimate.standard_error));
  }
  row.push_back(number_text(share.rays));
  row.push_back(number_text(share.ray_share));
  return row;
}

std::string percent(const Estimate& share) {
  const double t = measure::student_t(false_alarm_rate, share.degrees);
  return fmt::format("{:.1f} +- {:.1f}%", 100 * share.value, 100 * t * share.standard_error);
}

void print(const std::string& scene, const std::vector<TechniqueShare>& shares) {
  constexpr double least_shown = 0.01;
  say("{:<14} {:>16} {:>16} {:>12} {:>8}   (95% intervals)\n", "technique", "of the variance", "of the light",
      "alone", "of the rays");
  double subpaths = 1, rays_of_others = 0, variance_of_others = 0;
  int others = 0;
  for (const TechniqueShare& share : shares) {
    subpaths -= share.ray_share;
    if (std::max(share.variance_share.value, share.light.value) < least_shown) {
      ++others;
      variance_of_others += share.variance_share.value;
      rays_of_others += share.ray_share;
      continue;
    }
    say("{:<14} {:>16} {:>16} {:>12.4g} {:>7.1f}%\n", name_of(share.technique), percent(share.variance_share),
        percent(share.light), share.variance_alone.value, 100 * share.ray_share);
  }
  say("{:<14} {:>15.1f}% {:>42.1f}%\n", fmt::format("{} others", others), 100 * variance_of_others,
      100 * rays_of_others);
  say("{:<14} {:>59.1f}%\n{}: {}\n", "subpaths", 100 * subpaths, scene, techniques_answer(shares));
}

std::string command_of(const TechniquesOptions& options) {
  const TechniquesOptions defaults;
  return options.command("techniques",
                         text_of_values("--integrator", {options.integrator}, {defaults.integrator}) +
                             text_of_values("--weights", {options.weights}, {defaults.weights}));
}

} // namespace

std::string name_of(const film::Technique& technique) {
  if (technique == longer_paths) return "longer paths";
  return fmt::format("({}, {})", technique.light_vertices, technique.eye_vertices);
}

std::vector<TechniqueShare> technique_shares(const TechniqueRounds& rounds, const Reference& reference) {
  const std::vector<double> variances = variances_per_sample(rounds.images, reference);
  const std::vector<double> means = image_means(rounds.images);
  std::vector<TechniqueShare> shares;
  for (const auto& [technique, mine] : rounds.techniques) {
    TechniqueShare share;
    share.technique = technique;
    share.light = ratio_of(image_means(mine.weighted), means);
    share.covariances = covariances_per_sample(mine.weighted, rounds.images, reference);
    share.variance_share = ratio_of(share.covariances, variances);
    share.variance = mean_of(variances_per_sample(mine.weighted, reference));
    share.variance_alone = mean_of(variances_per_sample(mine.unweighted, reference));
    share.rays = mine.rays;
    share.ray_share = mine.rays / rounds.rays;
    shares.push_back(std::move(share));
  }
  std::ranges::stable_sort(shares, std::greater<>(),
                           [](const auto& share) { return share.variance_share.value; });
  return shares;
}

std::string techniques_answer(const std::vector<TechniqueShare>& shares) {
  const TechniqueShare& first = shares.front();
  const double level = measure::sidak_limit(false_alarm_rate, shares.size() - 1);
  std::vector<std::string> tied;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    std::vector<double> differences = first.covariances;
    for (std::size_t round = 0; round < differences.size(); ++round)
      differences[round] -= shares[i].covariances[round];
    if (p_value(mean_of(differences), 0) > level)
      tied.push_back(
          fmt::format("{} with {}", name_of(shares[i].technique), percent(shares[i].variance_share)));
  }
  return fmt::format(
      "{} causes {} {} of the variance; it brings {} of the light and takes {:.1f}% of the rays{}{}",
      name_of(first.technique), first.variance_share.value > 0.5 ? "most," : "the largest part,",
      percent(first.variance_share), percent(first.light), 100 * first.ray_share,
      tied.empty() ? "" : "; tied with ", enumeration(tied));
}

bool measure_techniques(const TechniquesOptions& options) try {
  const device::DeviceInfo device = device::open_devices(options.devices).front().info;
  const std::vector<std::filesystem::path> files = options.scenes.empty() ? shipped_scenes() : options.scenes;
  check_scenes(files);
  CsvFile table(options.folder, "techniques.csv", columns);
  StatusLine status;
  const Method method = method_of(options);
  std::string answers;
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    const scene::Scene scene = load_at_size(file, options.side());
    const TechniqueRounds rounds = render_rounds(scene, options, [&](int round) {
      status.show(fmt::format("{}: round {} of {}", name, round + 1, options.rounds()));
    });
    const Reference reference = pooled_reference(rounds.images, static_cast<std::size_t>(scene.camera.width));
    const std::vector<TechniqueShare> shares = technique_shares(rounds, reference);
    for (const TechniqueShare& share : shares)
      table.line(fmt::format("{},{},{},{},{},{},{}x{},{},{}", csv_value(name), method.integrator,
                             method.variant, fmt::join(values_of(share), ","), options.rounds(),
                             options.round_samples(), scene.camera.width, scene.camera.height, options.seed,
                             csv_value(device.name)));
    status.clear();
    answers += fmt::format("{}: {}\n", name, techniques_answer(shares));
    print(name, shares);
  }
  files::write_file(options.folder / "techniques.verdict.txt", answers);
  write_provenance(options.folder, "techniques",
                   {command_of(options), device, options.lanes_on(device),
                    "nothing is timed: rays are counted", options.seeds(options.rounds())});
  draw_charts(options.folder, "techniques");
  say("{}\n", table.path().string());
  return true;
} catch (const Interrupted&) {
  say("interrupted: {} contains the finished scenes\n", (options.folder / "techniques.csv").string());
  return false;
}

} // namespace phlux::bench
