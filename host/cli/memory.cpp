#include "cli/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "errors.h"
#include "film/film.h"
#include "film/first_hit.h"

namespace phlux::cli {
namespace {

// The number of techniques that are stored: for each path length of e edges, e + 1 by bidir and 1 by light.
int techniques(const settings::Settings& settings) {
  if (!settings.techniques) return 0;
  const int edges = settings.max_depth < 0 ? film::most_technique_edges
                                           : std::min(settings.max_depth, film::most_technique_edges);
  return settings::integrator_named(settings.integrator).bidirectional() ? edges * (edges + 3) / 2 : edges;
}

// The number after `name` in a file of lines such as "MemFree:  123 kB"; `name` may be empty. Infinite if
// there is none.
double number_in(const char* file, const std::string& name) {
  std::ifstream stream(file);
  double number = 0.0;
  for (std::string word; name.empty() || stream >> word;)
    if (name.empty() || word == name)
      return stream >> number ? number : std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::infinity();
}

double free_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  const double used = number_in("/proc/self/statm", "") * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return static_cast<double>(limit.rlim_cur) - used;
}

} // namespace

double memory_needed(double pixels, const settings::Settings& settings, const Outputs& outputs) {
  constexpr double preview = 6, contribution = 36; // bytes per pixel while one is written
  const settings::IntegratorInfo& integrator = settings::integrator_named(settings.integrator);
  const double film = film::Film::bytes(pixels, integrator.eye_paths ? 1 : 0, integrator.light_paths ? 1 : 0,
                                        settings::samples_point_sets(settings) ? 1 : 0, techniques(settings));
  return film + pixels * (outputs.aov.empty() ? 0.0 : double{sizeof(film::FirstHit)}) +
         pixels * std::max(outputs.preview.empty() ? 0 : preview, settings.techniques ? contribution : 0);
}

std::optional<double> memory_available() {
  constexpr double kilobyte = 1024.0;
  const double of_group =
      number_in("/sys/fs/cgroup/memory.max", "") - number_in("/sys/fs/cgroup/memory.current", "");
  const double most =
      std::min({kilobyte * number_in("/proc/meminfo", "MemAvailable:"),
                of_group >= 0.0 ? of_group : std::numeric_limits<double>::infinity(), free_address_space()});
  return most < std::numeric_limits<double>::infinity() ? std::optional(most) : std::nullopt;
}

void require_memory(const scene::Camera& camera, const settings::Settings& settings, const Outputs& outputs) {
  constexpr double gigabyte = 1e9;
  const double pixels = static_cast<double>(camera.width) * camera.height;
  const double needed = memory_needed(pixels, settings, outputs);
  const std::optional<double> available = memory_available();
  if (!available || needed <= *available) return;
  std::string remedy = "a smaller `size`";
  settings::Settings path = settings;
  path.integrator = "path";
  path.techniques = false;
  if (const double less = memory_needed(pixels, path, outputs); less < needed)
    remedy += fmt::format(", or `integrator` path (or light), which needs {:.2g} GB", less / gigabyte);
  throw UsageError(fmt::format("{}x{} pixels need {:.3g} GB of memory, and {:.3g} GB are free: {}",
                               camera.width, camera.height, needed / gigabyte, *available / gigabyte,
                               remedy));
}

} // namespace phlux::cli
