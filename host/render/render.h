// The dispatch loop: a scene and settings in, samples on a film out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "render/schedule.h"
#include "scene/scene.h"

namespace phlux::render {

enum class Connect { none, light, mis }; ///< what reaches the lights: hits, light samples, or both weighted
enum class Weights { balance, power, uniform }; ///< how bidirectional paths share a path's light (Veach 1997)
enum class LightSelection { power, contribution }; ///< which of many lights a light sample goes to
enum class Traversal { automatic, brute_force, bvh };

struct Settings {
  std::string integrator = "path";                               ///< path, light or bidir
  std::string strategy = "exact";                                ///< how directions are sampled, MATH.md 2.3
  Connect connect = Connect::mis;                                ///< path
  Weights weights = Weights::balance;                            ///< bidir
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
  std::vector<std::string> devices; ///< --device specifications
  int lanes = 0;                    ///< WIDTH; 0: what suits the device
  bool double_precision = false;    ///< kernels compute in double; WIDTH is 1
  Traversal traversal = Traversal::automatic;
  std::filesystem::path kernel_dir; ///< empty: the embedded kernels
  double launch_seconds = 0.05;     ///< aimed-at length of one launch
};

/// Names that `--strategy` takes, in the order in which help lists them.
[[nodiscard]] const std::vector<std::string>& strategy_names();
/// Names of the values of these types, in their order, as options take them.
[[nodiscard]] const std::vector<std::string>& connect_names();
[[nodiscard]] const std::vector<std::string>& weights_names();
[[nodiscard]] const std::vector<std::string>& light_selection_names();
[[nodiscard]] const std::vector<std::string>& traversal_names();

/// Where a contribution came from that was not finite: the seed, this pixel (row by row from the top) and
/// this sample, or one of so many from it, make it again.
struct Origin {
  std::int64_t pixel = 0, sample = 0;
  int samples = 1;
};

struct Counts {
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, nonfinite = 0;
  std::optional<Origin> first_nonfinite;
};

/// How far a render has come: with its film, all that another takes to go on.
struct Standing : Counts {
  Place place;
  double seconds_render = 0.0;
};

struct Progress {
  double samples_done = 0.0;           ///< mean samples per pixel so far
  std::optional<double> samples_total; ///< absent when time or error ends the render
  double seconds = 0.0;                ///< since rendering began
  std::uint64_t paths = 0;
  std::function<Standing()> standing = {}; ///< of what the film has; a little slow
};

struct Statistics : Standing {
  std::string device, driver;
  int lanes = 1;
  bool portable_lanes = false;    ///< the compiler refused the processor's own instructions
  std::string traversal;          ///< brute or bvh
  std::vector<std::string> parts; ///< what the scene's kernel holds code for
  double seconds_setup = 0.0, seconds_build_kernels = 0.0;
  bool kernels_from_cache = false;
  bool shines = true; ///< some light of the scene has power
  bool interrupted = false;
};

struct Events {
  std::function<void()> building_kernels; ///< building has taken longer than 200 ms
  /// Called between launches, at most every 50 ms or so; false ends the render, keeping what the film has.
  std::function<bool(const Progress&)> progress;
};

/// Adds samples to `film`, which has the camera's width and height; where an earlier render of the scene with
/// these settings had come to `from`, the film is the one that it left, and the samples, seconds and counts
/// include its own. One device then makes the film that it would have made without a break, bit for bit.
/// @throws UsageError for settings that cannot work, SceneError for a scene that cannot be rendered,
/// DeviceError
[[nodiscard]] Statistics render(const scene::Scene& scene, const Settings& settings, film::Film& film,
                                const Events& events, const Standing& from = {});

} // namespace phlux::render
