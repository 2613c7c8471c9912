#include "verify/integrators/check_integrators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "measure/moments.h"
#include "measure/statistics.h"
#include "render/programs.h"
#include "render/render.h"
#include "verify/checks.h"
#include "verify/integrators/furnace.h"
#include "verify/integrators/methods.h"

namespace phlux::verify {
namespace {

// Of the mean, relative: positions in float32 and the offsets of rays from surfaces.
constexpr double float_error = 1e-4;

// Means over the image by check, one for each render. Renders are independent, pixels of one are not: light
// paths splat to several.
using Means = std::map<std::string, std::vector<Rgb>>;

Rgb mean_of(const std::vector<std::array<double, 3>>& pixels) {
  Rgb sum(0);
  for (const auto& pixel : pixels) sum += Rgb(pixel[0], pixel[1], pixel[2]);
  return sum / static_cast<double>(pixels.size());
}

Rgb mean_of(const film::Film& film) {
  std::vector<std::array<double, 3>> pixels;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) pixels.push_back(film.mean(i));
  return mean_of(pixels);
}

void add_techniques(film::Film& film, Means& means) {
  const auto& sums = film.techniques()->sums();
  for (int edges = 1; edges <= technique_edges; ++edges) {
    Rgb weighted(0);
    for (const film::Technique& technique : techniques_of(edges)) {
      const auto found = sums.find(technique);
      const bool none = found == sums.end();
      means[check_of(technique)].push_back(none ? Rgb(0)
                                                : mean_of(film.technique_image(found->second.unweighted)));
      if (!none) weighted += mean_of(film.technique_image(found->second.weighted));
    }
    means[check_of_length(edges)].push_back(weighted);
  }
}

struct Room {
  const char* check;
  scene::Scene scene;
  int samples; // per pixel and render
};

// One method on one device.
class MethodChecks {
public:
  MethodChecks(const Method& method, render::Programs& programs, int lanes, bool thin, Report& report)
      : method_(method), programs_(programs), lanes_(lanes), thin_(thin), report_(report) {}

  void run() const {
    const Room room{"furnace", furnace(), method_.samples};
    const Means means = render(room, with_depth(method_.settings.max_depth));
    if (method_.settings.techniques)
      check_techniques(means);
    else if (compare(room.check, means, furnace_radiance_up_to(-1)) < suspicious_p)
      diagnose(room);
    if (method_.glossy_samples == 0 || thin_) return;
    const Room glossy{"glossy furnace", glossy_furnace(), method_.glossy_samples};
    compare(glossy.check, render(glossy, with_depth(glossy_edges)), glossy_furnace_radiance());
  }

private:
  [[nodiscard]] settings::Settings with_depth(int edges) const {
    settings::Settings settings = method_.settings;
    settings.max_depth = edges;
    settings.lanes = lanes_;
    return settings;
  }

  [[nodiscard]] Means render(const Room& room, settings::Settings settings) const {
    settings.samples_per_pixel = thin_ ? 1 : room.samples;
    render::Renderer renderer(programs_, room.scene, settings);
    const int renders = thin_ ? 8 : 64;
    Means means;
    std::uint64_t nonfinite = 0;
    for (int i = 0; i < renders; ++i) {
      settings.seed = static_cast<std::uint64_t>(i);
      film::Film film(room.scene.camera.width, room.scene.camera.height);
      nonfinite += renderer.render(settings, film, {}).nonfinite;
      if (settings.techniques)
        add_techniques(film, means);
      else
        means[room.check].push_back(mean_of(film));
    }
    report_.record(method_.name, "finite", static_cast<double>(nonfinite), 0, room.check);
    return means;
  }

  struct Test {
    double p;
    std::string where; // how far the mean is from the radiance
  };

  // Of each channel.
  static std::vector<Test> tests_of(const std::vector<Rgb>& means, const Rgb& radiance) {
    std::vector<Test> tests;
    for (int channel = 0; channel < 3; ++channel) {
      PowerSums sums;
      sums.centre = radiance[channel];
      for (const Rgb& mean : means) sums.add(mean[channel]);
      const Moments moments = moments_of(sums);
      const double off = moments.mean / radiance[channel] - 1;
      const double error = moments.mean_standard_error / radiance[channel];
      const double beyond = std::max(0.0, std::abs(off) - float_error);
      const double t = beyond == 0 ? 0 : beyond / error; // infinite where all means are equal and wrong
      tests.push_back({measure::student_p(t, static_cast<double>(means.size() - 1)),
                       fmt::format("{:.3g}% +- {:.2g}% too {} in channel {}", 100 * std::abs(off),
                                   100 * error, off < 0 ? "dark" : "bright", "RGB"[channel])});
    }
    return tests;
  }

  // Records the p-values; returns the smallest.
  double compare(const std::string& check, const Means& means, const Rgb& radiance) const {
    double smallest = 1;
    for (const Test& test : tests_of(means.at(check), radiance)) {
      report_.record_p(method_.name, check, test.p, test.where);
      smallest = std::min(smallest, test.p);
    }
    return smallest;
  }

  void check_techniques(const Means& means) const {
    for (int edges = 1; edges <= technique_edges; ++edges) {
      for (const film::Technique& technique : techniques_of(edges))
        compare(check_of(technique), means, furnace_radiance(edges));
      compare(check_of_length(edges), means, furnace_radiance(edges));
    }
  }

  [[nodiscard]] bool is_right(const Room& room, const settings::Settings& settings) const {
    const Means means = render(room, settings);
    return std::ranges::all_of(tests_of(means.at(room.check), furnace_radiance_up_to(settings.max_depth)),
                               [](const Test& test) { return test.p >= suspicious_p; });
  }

  // Notes from which length of paths on the mean is wrong and, for bidir, whether it is right without
  // roulette of connections, which begins at 5 edges.
  void diagnose(const Room& room) const {
    constexpr int longest = 8;
    int edges = 1;
    while (edges <= longest && is_right(room, with_depth(edges))) ++edges;
    std::string note = fmt::format("it shows with paths of {}",
                                   edges <= longest ? check_of_length(edges) + " or more"
                                                    : fmt::format("more than {} edges", longest));
    if (method_.settings.integrator == "bidir" && edges > method_.settings.connections + 2) {
      settings::Settings all_connections = with_depth(-1);
      all_connections.connections = 0;
      if (is_right(room, all_connections)) {
        note += "; `connections` 0 is right";
        report_.look_at(method_.name, room.check, "take_pairs (kernels/transport/bidir.cl)");
      }
    }
    report_.note(method_.name, room.check, note);
  }

  const Method& method_;
  render::Programs& programs_;
  int lanes_;
  bool thin_; // few samples, and one room: on interpreters
  Report& report_;
};

bool is_chosen(const Method& method, const Settings& settings) {
  const bool named =
      settings.integrators.empty() ||
      std::ranges::find(settings.integrators, method.settings.integrator) != settings.integrators.end();
  return named && (method.quick || !settings.quick);
}

} // namespace

void check_integrators(const device::Device& device, const Settings& settings, Report& report) {
  render::Programs programs(device, settings.kernels);
  const bool thin = samples_of(device, settings) < thin_samples;
  for (const Method& method : methods())
    if (is_chosen(method, settings)) MethodChecks(method, programs, settings.lanes, thin, report).run();
}

} // namespace phlux::verify
