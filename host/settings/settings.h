// The settings of a render. A new one needs a member of Settings and an entry of declared_settings(), from
// which options and their help, messages, checkpoints, images' attributes and statistics follow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "settings/integrators.h"
#include "settings/setting.h"
#include "settings/strategies.h"

namespace phlux::settings {

enum class Connect { none, light, mis };        ///< direct light from hits, light samples, or both with MIS
enum class Weights { balance, power, uniform }; ///< weights of bidirectional techniques (Veach 1997)
enum class LightSelection { power, contribution };  ///< probabilities of lights for light samples
enum class Sampler { independent, sobol, lattice }; ///< how the samples of a pixel are related
/// Survival probability of Russian roulette: that of the sampling strategy or model, the reflectivity of the
/// vertex, kd + ks, the throughput x reflectivity (survivors have throughput 1), or twice that.
enum class Roulette { strategy, reflectivity, kd_ks, throughput, efficiency };
enum class Traversal { automatic, brute_force, bvh };

struct Settings {
  std::string integrator = "path";    ///< path, light or bidir; auto before advice::choose_method()
  std::string strategy = "exact";     ///< of sampling directions: a name, or a user's FILE.cl
  Connect connect = Connect::mis;     ///< path
  Weights weights = Weights::balance; ///< bidir
  LightSelection light_selection = LightSelection::contribution; ///< path, bidir
  int connections = 2;     ///< bidir: mean number of connections made per path length, by roulette; 0: all
  bool techniques = false; ///< light, bidir: the film also records each technique's contributions
  Roulette roulette = Roulette::efficiency; ///< survival probability of Russian roulette
  Sampler sampler = Sampler::independent;   ///< path, bidir
  std::optional<double> ambient;      ///< path: radiance of a control variate (CW 197, 2.2, reference 15)
  std::optional<double> clamp;        ///< largest contribution of a path to a pixel, a radiance; causes bias
  int samples_per_pixel = 4;          ///< ignored with a time limit or target error
  std::optional<double> time_limit;   ///< seconds of rendering
  std::optional<double> target_error; ///< mean relative standard error
  int max_depth = -1, rr_depth = 5;   ///< as in scene::RenderDefaults
  std::optional<scene::Window> crop;  ///< the part of the image that the scene's camera now has
  std::uint64_t seed = 0;
  std::int64_t first_sample = 0;    ///< index of every pixel's first sample
  std::vector<std::string> devices; ///< specifications of device::open_devices()
  std::optional<int> threads;       ///< of each device, a CPU; absent: all that it has
  int lanes = 0;                    ///< WIDTH; 0: the device's
  bool double_precision = false;    ///< kernels compute in double; WIDTH is 1
  Traversal traversal = Traversal::automatic;
  std::filesystem::path kernel_dir; ///< empty: the embedded kernels
  double launch_seconds = 0.05;     ///< target duration of a launch
  double pause_seconds = 1.0;       ///< until a device that failed is tried again
};

/// How eye subpaths find light, if there are lights: by hits and light samples in bidir, `connect` in path.
/// Light tracing, which has no eye subpaths, takes no light samples.
[[nodiscard]] inline Connect connect_of(const Settings& settings) {
  const IntegratorInfo& integrator = integrator_named(settings.integrator);
  if (!integrator.eye_paths) return Connect::none;
  return integrator.light_paths ? Connect::mis : settings.connect;
}
/// Whether eye subpaths take light samples, if there are lights.
[[nodiscard]] inline bool samples_lights(const Settings& settings) {
  return connect_of(settings) != Connect::none;
}
/// Whether light samples choose lights by contribution.
[[nodiscard]] inline bool wants_light_tree(const Settings& settings) {
  return samples_lights(settings) && settings.light_selection == LightSelection::contribution;
}

/// Whether the samples of a pixel are points of sets.
[[nodiscard]] inline bool samples_point_sets(const Settings& settings) {
  return settings.sampler != Sampler::independent && integrator_named(settings.integrator).eye_paths;
}

/// Names of the values of Connect and Weights, in their order.
[[nodiscard]] inline const std::vector<std::string>& connect_names() {
  static const std::vector<std::string> names = {"none", "light", "mis"};
  return names;
}
[[nodiscard]] inline const std::vector<std::string>& weights_names() {
  static const std::vector<std::string> names = {"balance", "power", "uniform"};
  return names;
}

/// Names of the values of Sampler, in their order.
[[nodiscard]] inline const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> names = {"independent", "sobol", "lattice"};
  return names;
}

[[nodiscard]] inline const std::vector<std::string>& roulette_names() { ///< of Roulette
  static const std::vector<std::string> names = {"strategy", "reflectivity", "kd-ks", "throughput",
                                                 "efficiency"};
  return names;
}

/// integrator_names(), and auto.
[[nodiscard]] inline std::vector<std::string> integrator_choices() {
  std::vector<std::string> names = integrator_names();
  names.emplace_back("auto");
  return names;
}

/// Samples of a pixel are numbered below it, from `first-sample` on: the kernels' numbers are ints.
inline constexpr std::int64_t most_samples = std::numeric_limits<std::int32_t>::max();

/// The settings that can be given as texts, in the order of the help.
[[nodiscard]] inline std::vector<Setting> declared_settings() {
  using A = Affects;
  const auto from_eye_alone = [](const Settings& s) { return !integrator_named(s.integrator).light_paths; };
  const auto bidirectional = [](const Settings& s) { return integrator_named(s.integrator).bidirectional(); };
  return {
      Setting("integrator", A::estimate, &Settings::integrator, OneOf{integrator_choices()}, "NAME",
              "path, light or bidir; or auto: the one with the least error in trial renders, which take 3% "
              "of the time")
          .or_scene(&Settings::integrator, &scene::RenderDefaults::integrator),
      Setting("strategy", A::estimate, &Settings::strategy, StrategyOrFile{}, "NAME|FILE.cl",
              "how directions of the phong model are sampled: " + joined(strategy_names()) +
                  ", or a kernel file of your own"),
      Setting("connect", A::estimate, &Settings::connect, OneOf{connect_names()}, "NAME",
              "path only, how direct light is found: none (by paths that hit lights), light (by light "
              "samples) or "
              "mis (by both, with multiple importance sampling)")
          .only_where(from_eye_alone, " is for path only: {} finds lights by other techniques"),
      Setting(
          "weights", A::estimate, &Settings::weights, OneOf{weights_names()}, "NAME",
          "bidir only, weights of the techniques in multiple importance sampling: balance, power or uniform")
          .only_where(bidirectional, " is for bidir only: {} has one technique for each path: leave it out "
                                     "or use `integrator` bidir"),
      Setting(
          "light-selection", A::estimate, &Settings::light_selection, OneOf{{"power", "contribution"}},
          "NAME",
          "path and bidir, how light samples choose a light: by power (half in proportion to power, half "
          "uniformly over the emitters), or by the estimated contribution to the point (with fewer than 8 "
          "lights always by power)")
          .only_where(samples_lights,
                      " is for light samples, which `integrator` light and `connect` none do not "
                      "take: leave it out"),
      Setting(
          "connections", A::estimate, &Settings::connections, Whole{0, 1'000'000}, "N",
          "bidir only: a path of e edges can be made by e - 2 connections between inner vertices of the two "
          "subpaths; on average N of them are made, chosen by Russian roulette without bias; 0: all")
          .only_where([](const Settings& s) { return !s.techniques; },
                      ": `contributions` needs every connection: leave out one of the two")
          .only_where(
              bidirectional,
              " is for bidir only: {} connects no inner vertices: leave it out or use `integrator` bidir"),
      Setting("sampler", A::estimate, &Settings::sampler, OneOf{sampler_names()}, "NAME",
              "path and bidir, random numbers of a pixel's samples: independent, or low-discrepancy points, "
              "which have less noise: sobol (scrambled Sobol points) or lattice (shifted lattices)")
          .only_where([](const Settings& s) { return integrator_named(s.integrator).eye_paths; },
                      " is for path and bidir only: leave it out"),
      Setting("contributions", A::film, &Settings::techniques, Switch{"DIR"}, "", ""),
      Setting("ambient", A::estimate, &Settings::ambient, Within{1e-30, 1e30}, "L",
              "path only: a control variate with the constant incident radiance L, which reduces noise most "
              "if L is "
              "near the mean incident radiance, and has no bias for any L; default: no control variate")
          .only_where(from_eye_alone, " is for path only: use `integrator` path")
          .only_where([](const Settings& s) { return !s.clamp; },
                      ": contributions of a control variate, which may be negative, are not clamped: leave "
                      "out `ambient` or `clamp`"),
      Setting(
          "clamp", A::expectation, &Settings::clamp, Within{1e-30, 1e30}, "X",
          "limits the contribution of each path to a pixel to the radiance X; this reduces noise but causes "
          "a bias, which the log and the image's attributes state; default: no limit"),
      Setting("max-depth", A::expectation, &Settings::max_depth, Depth{}, "N",
              "largest number of edges of a path; 1: only emission, 2: direct light too, -1: no limit")
          .or_scene(&Settings::max_depth, &scene::RenderDefaults::max_depth),
      Setting("rr-depth", A::estimate, &Settings::rr_depth, Depth{}, "N",
              "number of edges from which on Russian roulette may end a path; -1: never")
          .or_scene(&Settings::rr_depth, &scene::RenderDefaults::rr_depth),
      Setting("roulette", A::estimate, &Settings::roulette, OneOf{roulette_names()}, "NAME",
              "survival probability of Russian roulette: efficiency (2 x throughput x reflectivity), "
              "throughput (as "
              "in Mitsuba and pbrt: survivors have throughput 1), reflectivity, kd-ks (kd + ks), or strategy "
              "(that "
              "of the sampling strategy: for exact the reflectivity, for lobe-ks kd + ks)")
          .only_where([](const Settings& s) { return s.rr_depth >= 0; },
                      ": with `rr-depth` -1 there is no roulette: leave out one of the two"),
      Setting("spp", A::amount, &Settings::samples_per_pixel, Whole{1, std::uint64_t{most_samples}}, "N",
              "samples per pixel; for light: number of light paths / number of pixels")
          .or_scene(&Settings::samples_per_pixel, &scene::RenderDefaults::samples_per_pixel),
      Setting("time", A::amount, &Settings::time_limit, Within{1e-6, 1e9}, "SECONDS",
              "renders for this time instead of a number of samples"),
      Setting("error", A::amount, &Settings::target_error, Within{1e-30, 1e30}, "E",
              "renders until the mean relative standard error of the pixels that are not black is E, such as "
              "0.01; "
              "with `time`: or until that time"),
      Setting("crop", A::expectation, &Settings::crop, Crop{}, "X,Y,W,H",
              "renders only this part of the image: left edge, upper edge, width and height in pixels")
          .or_scene(&Settings::crop, &scene::RenderDefaults::crop),
      Setting("seed", A::samples, &Settings::seed, Whole{0, std::numeric_limits<std::uint64_t>::max()}, "N",
              "seed of the random numbers; the same seed gives the same image on the same device"),
      Setting(
          "first-sample", A::samples, &Settings::first_sample, Whole{0, std::uint64_t{most_samples} / 2}, "N",
          "index of every pixel's first sample; renders of samples 0 to 99 and of 100 to 199 of one seed are "
          "independent and can be merged"),
      Setting("threads", A::execution, &Settings::threads, Whole{1, 65'536}, "N",
              "number of threads of a CPU; default: all"),
      Setting(
          "width", A::execution, &Settings::lanes, OneOf{{"1", "4", "8", "16"}}, "N",
          "number of paths that a work-item traces together: 1, 4, 8 or 16; default: what suits the device"),
      Setting("precision", A::estimate, &Settings::double_precision, OneOf{{"single", "double"}}, "NAME",
              "arithmetic of the kernels: single; or double, which is slower, has `width` 1, and needs a "
              "device with "
              "doubles"),
      Setting("traversal", A::execution, &Settings::traversal, OneOf{{"auto", "brute", "bvh"}}, "NAME",
              "ray intersection: brute (tests every shape), bvh, or auto (brute if there are few shapes)"),
  };
}

/// declared_settings(), computed once.
[[nodiscard]] const std::vector<Setting>& all();
/// The setting of this name. @throws UsageError if there is none
[[nodiscard]] const Setting& named(std::string_view name);
/// Texts by name of the settings whose `affects` is wanted, without absent values.
[[nodiscard]] std::map<std::string, std::string> texts_of(const Settings& settings,
                                                          const std::function<bool(Affects)>& wanted);

} // namespace phlux::settings
