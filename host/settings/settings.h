// All that a render may be told. A new setting is a member here and an entry of the list below; options and
// their help, what scenes say, messages, checkpoints, images' attributes and statistics follow from those.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "settings/integrators.h"
#include "settings/setting.h"
#include "settings/strategies.h"

namespace phlux::settings {

enum class Connect { none, light, mis }; ///< what reaches the lights: hits, light samples, or both weighted
enum class Weights { balance, power, uniform }; ///< how bidirectional paths share a path's light (Veach 1997)
enum class LightSelection { power, contribution }; ///< which of many lights a light sample goes to
enum class Traversal { automatic, brute_force, bvh };

struct Settings {
  std::string integrator = "path";    ///< path, light or bidir
  std::string strategy = "exact";     ///< how directions are sampled: a name, or a user's FILE.cl
  Connect connect = Connect::mis;     ///< path
  Weights weights = Weights::balance; ///< bidir
  LightSelection light_selection = LightSelection::contribution; ///< path, bidir
  int connections = 2;     ///< bidir: a path of e edges is made by so many of its e - 2; 0: by all
  bool techniques = false; ///< light, bidir: the film keeps what each technique brings by itself as well
  std::optional<double> ambient;      ///< path: radiance of a control variate (CW 197, 2.2, reference 15)
  std::optional<double> clamp;        ///< most radiance that a path brings to a pixel: a bias
  int samples_per_pixel = 4;          ///< ignored where a time or an error is asked for
  std::optional<double> time_limit;   ///< seconds of rendering
  std::optional<double> target_error; ///< mean relative standard error
  int max_depth = -1, rr_depth = 5;   ///< as in scene::RenderDefaults
  std::uint64_t seed = 0;
  std::int64_t first_sample = 0;    ///< the number of every pixel's first sample
  std::vector<std::string> devices; ///< specifications as device::open_devices() takes them
  int lanes = 0;                    ///< WIDTH; 0: what suits the device
  bool double_precision = false;    ///< kernels compute in double; WIDTH is 1
  Traversal traversal = Traversal::automatic;
  std::filesystem::path kernel_dir; ///< empty: the embedded kernels
  double launch_seconds = 0.05;     ///< aimed-at length of one launch
};

/// Whether paths from the eye sample lights, if there are any.
[[nodiscard]] inline bool samples_lights(const Settings& settings) {
  const IntegratorInfo& integrator = integrator_named(settings.integrator);
  return integrator.eye_paths && (integrator.light_paths || settings.connect != Connect::none);
}
/// Whether those samples choose by contribution.
[[nodiscard]] inline bool wants_light_tree(const Settings& settings) {
  return samples_lights(settings) && settings.light_selection == LightSelection::contribution;
}

/// Names of the values of these types, in their order.
[[nodiscard]] inline const std::vector<std::string>& connect_names() {
  static const std::vector<std::string> names = {"none", "light", "mis"};
  return names;
}
[[nodiscard]] inline const std::vector<std::string>& weights_names() {
  static const std::vector<std::string> names = {"balance", "power", "uniform"};
  return names;
}

/// The settings that a text can say, in the order in which help lists them.
[[nodiscard]] inline std::vector<Setting> declared_settings() {
  using A = Affects;
  constexpr std::uint64_t most_samples = std::numeric_limits<std::int32_t>::max(); // of the kernels' int
  const auto from_eye_alone = [](const Settings& s) { return !integrator_named(s.integrator).light_paths; };
  const auto bidirectional = [](const Settings& s) { return integrator_named(s.integrator).bidirectional(); };
  return {
      Setting("integrator", A::estimate, &Settings::integrator, OneOf{integrator_names()}, "NAME",
              "path, light or bidir")
          .or_scene(&Settings::integrator, &scene::RenderDefaults::integrator),
      Setting("strategy", A::estimate, &Settings::strategy, StrategyOrFile{}, "NAME|FILE.cl",
              "how directions of the phong model are sampled: " + joined(strategy_names()) +
                  ", or by a kernel file of your own"),
      Setting(
          "connect", A::estimate, &Settings::connect, OneOf{connect_names()}, "NAME",
          "path only, what reaches the lights: none (hits), light (light samples) or mis (both, weighted)")
          .only_where(from_eye_alone, " is for path alone: {} has its own ways to the lights"),
      Setting("weights", A::estimate, &Settings::weights, OneOf{weights_names()}, "NAME",
              "bidir only, how the ways to make a path share its light: balance, power or uniform")
          .only_where(
              bidirectional,
              " is for bidir alone: {} makes each path in one way: leave it out or use `integrator` bidir"),
      Setting("light-selection", A::estimate, &Settings::light_selection, OneOf{{"power", "contribution"}},
              "NAME",
              "path and bidir, which of many lights a light sample goes to: by power, or by the contribution "
              "that it is likely to bring to the point, of 8 lights and more")
          .only_where(samples_lights,
                      " is for light samples, which neither `integrator` light nor `connect` none "
                      "makes: leave it out"),
      Setting("connections", A::estimate, &Settings::connections, Whole{0, 1'000'000}, "N",
              "bidir only: of the connections that can make a path, one for each edge but two, N are made on "
              "average, and bring as much as all; 0: all are made")
          .only_where([](const Settings& s) { return !s.techniques; },
                      ": `contributions` shows every connection: leave out one of the two")
          .only_where(bidirectional,
                      " is for bidir alone: {} connects no vertices: leave it out or use `integrator` bidir"),
      Setting("contributions", A::film, &Settings::techniques, Switch{"DIR"}, "", ""),
      Setting(
          "ambient", A::estimate, &Settings::ambient, Positive{}, "L",
          "path only: a radiance that is about what arrives everywhere, as a control variate: the nearer the "
          "guess, the less noise; the mean stays right whatever it is")
          .only_where(from_eye_alone,
                      ": only paths from the eye can carry the ambient term: use `integrator` path"),
      Setting(
          "clamp", A::expectation, &Settings::clamp, Positive{}, "X",
          "no path brings a pixel more radiance than X: less noise, and a bias, which the log and the files "
          "name"),
      Setting("max-depth", A::expectation, &Settings::max_depth, Depth{}, "N",
              "edges of the longest path: 1 is emission alone, -1 unbounded")
          .or_scene(&Settings::max_depth, &scene::RenderDefaults::max_depth),
      Setting("rr-depth", A::estimate, &Settings::rr_depth, Depth{}, "N",
              "edges from which roulette may end a path, -1: never")
          .or_scene(&Settings::rr_depth, &scene::RenderDefaults::rr_depth),
      Setting("spp", A::amount, &Settings::samples_per_pixel, Whole{1, most_samples}, "N",
              "samples a pixel (light: light paths per pixel of the image)")
          .or_scene(&Settings::samples_per_pixel, &scene::RenderDefaults::samples_per_pixel),
      Setting("time", A::amount, &Settings::time_limit, Positive{}, "SECONDS", "render for so long instead"),
      Setting(
          "error", A::amount, &Settings::target_error, Positive{}, "E",
          "render until the mean relative standard error of what is not black is E instead, such as 0.01; "
          "with `time`: until the first of both"),
      Setting("seed", A::samples, &Settings::seed, Whole{0, std::numeric_limits<std::uint64_t>::max()}, "N",
              "the same seed gives the same image on the same device"),
      Setting("first-sample", A::samples, &Settings::first_sample, Whole{0, most_samples / 2}, "N",
              "number of every pixel's first sample: renders of samples 0 to 99 and 100 to 199 of a seed are "
              "independent, for `phlux merge`"),
      Setting("width", A::execution, &Settings::lanes, OneOf{{"1", "4", "8", "16"}}, "N",
              "paths that one work-item traces at a time: 1, 4, 8 or 16; default: what suits the device"),
      Setting("precision", A::estimate, &Settings::double_precision, OneOf{{"single", "double"}}, "NAME",
              "what kernels compute in: single, or double, one path at a time and only where the device has "
              "doubles"),
      Setting("traversal", A::execution, &Settings::traversal, OneOf{{"auto", "brute", "bvh"}}, "NAME",
              "brute (every shape), bvh or auto"),
  };
}

/// The same, made once.
[[nodiscard]] const std::vector<Setting>& all();
/// One of them. @throws UsageError where there is none of that name
[[nodiscard]] const Setting& named(const std::string& name);
/// The texts of those that have an effect on what is `wanted`, by their names; without absent values.
[[nodiscard]] std::map<std::string, std::string> texts_of(const Settings& settings,
                                                          const std::function<bool(Affects)>& wanted);

} // namespace phlux::settings
