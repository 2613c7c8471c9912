// The integrators: their names and how they form paths.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "settings/values.h"

namespace phlux::settings {

enum class Integrator { path, light, bidir };

struct IntegratorInfo {
  Integrator integrator;
  const char* name;         ///< in options, messages and files
  const char* mitsuba_name; ///< in scene files
  const char* kernel_file;
  const char* kernel;
  /// Eye subpaths: kernels sum contributions per pixel.
  bool eye_paths;
  /// Light subpaths: kernels record each contribution with its pixel, in batches.
  bool light_paths;

  /// Connects eye and light subpaths, whose vertices are kept in memory; there are many techniques per path.
  [[nodiscard]] constexpr bool bidirectional() const { return eye_paths && light_paths; }
};

/// In the order of Integrator.
inline constexpr std::array<IntegratorInfo, 3> integrators = {{
    {Integrator::path, "path", "path", "transport/path.cl", "trace_paths", true, false},
    {Integrator::light, "light", "ptracer", "transport/light.cl", "trace_light", false, true},
    {Integrator::bidir, "bidir", "bdpt", "transport/bidir.cl", "trace_bidir", true, true},
}};

[[nodiscard]] constexpr const IntegratorInfo& info_of(Integrator integrator) {
  return integrators[static_cast<std::size_t>(integrator)];
}
[[nodiscard]] inline const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names = names_in(integrators);
  return names;
}
/// @throws UsageError for an unknown name
[[nodiscard]] inline const IntegratorInfo& integrator_named(const std::string& name) {
  return integrators[choice(quoted("integrator"), name, integrator_names())];
}

} // namespace phlux::settings
