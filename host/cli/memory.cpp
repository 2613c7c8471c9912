#include "cli/memory.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
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

MemoryNeed memory_needed(double pixels, const settings::Settings& settings, const Outputs& outputs) {
  constexpr double contribution = 36; // bytes per pixel while one is written
  const settings::IntegratorInfo& integrator = settings::integrator_named(settings.integrator);
  const int point_sets = settings::samples_point_sets(settings) ? 1 : 0;
  const double samples = film::Film::bytes(pixels, integrator.eye_paths ? 1 : 0, 0, point_sets, 0);
  const double splats = film::Film::bytes(pixels, 0, integrator.light_paths ? 1 : 0, 0, techniques(settings));
  const double outputs_of_film = pixels * ((outputs.aov.empty() ? 0.0 : double{sizeof(film::FirstHit)}) +
                                           (settings.techniques ? contribution : 0.0));
  return {samples + splats + outputs_of_film, samples};
}

std::optional<double> memory_available() {
  constexpr double kilobyte = 1024.0;
  const auto cached = [](const char* kind) { // the system frees it when memory is short
    const double bytes = number_in("/sys/fs/cgroup/memory.stat", kind);
    return std::isfinite(bytes) ? bytes : 0.0;
  };
  const double of_group = number_in("/sys/fs/cgroup/memory.max", "") -
                          number_in("/sys/fs/cgroup/memory.current", "") + cached("inactive_file") +
                          cached("active_file");
  const double most =
      std::min({kilobyte * number_in("/proc/meminfo", "MemAvailable:"),
                of_group >= 0.0 ? of_group : std::numeric_limits<double>::infinity(), free_address_space()});
  return most < std::numeric_limits<double>::infinity() ? std::optional(most) : std::nullopt;
}

film::Storage storage_for(const scene::Camera& camera, const settings::Settings& settings,
                          const Outputs& outputs, std::optional<double> most) {
  const auto gigabytes = [](double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); };
  const double pixels = static_cast<double>(camera.width) * camera.height;
  const auto [memory, in_file] = memory_needed(pixels, settings, outputs);
  const std::optional<double> limit = most ? most : memory_available();
  if (!limit || memory <= *limit) return film::Storage::memory;
  const std::string need =
      fmt::format("{}x{} pixels need {} of memory, and {} {}", camera.width, camera.height, gigabytes(memory),
                  gigabytes(*limit), most ? "are allowed by --memory" : "are free");
  if (in_file > 0.0 && memory - in_file <= *limit && in_file <= film::ScratchFile::room()) {
    spdlog::warn("{}: {} of them are in a file in {}", need, gigabytes(in_file), film::ScratchFile::folder());
    return film::Storage::file;
  }
  std::string remedy;
  if (in_file > 0.0 && memory - in_file <= *limit)
    remedy =
        fmt::format(", or {} on a disk, in a folder named by the variable TMPDIR (in {} there are {})",
                    gigabytes(in_file), film::ScratchFile::folder(), gigabytes(film::ScratchFile::room()));
  settings::Settings path = settings;
  path.integrator = "path";
  path.techniques = false;
  if (const double less = memory_needed(pixels, path, outputs).memory; less < memory)
    remedy += fmt::format(", or `integrator` path (or light), which needs {}", gigabytes(less));
  throw UsageError(fmt::format("{}: a smaller `size`{}", need, remedy));
}

film::Storage storage_for(const std::filesystem::path& checkpoint, std::optional<double> most) {
  constexpr double bytes_of_film = 4.0 / 3.0; // per byte of the file, see checkpoint::read
  std::error_code unknown;
  const auto size = static_cast<double>(std::filesystem::file_size(checkpoint, unknown));
  const std::optional<double> limit = most ? most : memory_available();
  return !unknown && limit && bytes_of_film * size > *limit ? film::Storage::file : film::Storage::memory;
}

} // namespace phlux::cli
