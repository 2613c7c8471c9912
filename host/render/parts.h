// The parts of a scene that its kernel needs code for, each a macro of the kernels.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "accel/geometry.h"
#include "device/program.h"
#include "lobes/program.h"
#include "render/render.h"
#include "tables/light_table.h"

namespace phlux::render {

/// Largest number of entries of a table that is kept in the registers of a CPU: TABLE_ENTRIES of
/// kernels/lanes/memory.h.
inline constexpr std::size_t few_entries = 16;

struct Parts {
  Integrator integrator = Integrator::path;
  int lanes = 1;
  bool hierarchy = false;
  bool double_precision = false; ///< kernels/lanes/lanes.h: Real is a double
  bool triangles = false, parallelograms = false, ellipses = false, spheres = false;
  bool smooth_normals = false, strict_normals = false, two_sided = false, black = false, masks = false;
  bool checkerboards = false, byte_textures = false, float_textures = false;
  std::vector<lobes::ModelPointer> models = {lobes::shipped("diffuse")}; ///< reflectance models
  bool light_planar = false, light_sphere = false, light_point = false, light_spot = false,
       light_directional = false, light_constant = false, environment_map = false;
  bool lens = false, orthographic = false;           ///< of the camera
  bool tent_filter = false, gaussian_filter = false; ///< else the box
  bool ambient = false;                              ///< a control variate: Settings::ambient
  bool light_choice = false;                         ///< more than one light to choose from
  bool hidden_emitters = false;                      ///< from the camera
  bool light_tree = false;                           ///< light samples choose by contribution
  bool sky_samples = false;                          ///< light samples may choose the sky
  bool one_light = false, few_lights = false, few_materials = false,
       few_primitives = false; ///< at most few_entries, which fit registers
  Connect connect = Connect::mis;
  Weights weights = Weights::balance;
  Sampler sampler = Sampler::independent;
  Roulette roulette = Roulette::strategy;
  int connections = 0;            ///< as in Settings; 0: no roulette of connections
  bool techniques = false;        ///< records every contribution with its technique
  std::optional<double> clamp;    ///< largest contribution of a path to its own pixel, in units of the lights
  std::string strategy = "exact"; ///< of the phong model: a name, or a user's FILE.cl

  [[nodiscard]] bool has_model(const std::string& name) const;
  [[nodiscard]] bool has_tangents() const; ///< whether a model needs them
  [[nodiscard]] bool has_textures() const { return checkerboards || byte_textures || float_textures; }
  /// The names of the parts that are on, such as "spheres" or "light_planar", in a fixed order.
  [[nodiscard]] std::vector<std::string> names() const;
  /// The names of all parts, whether on or off.
  [[nodiscard]] static std::vector<std::string> all_names();
  /// @throws std::out_of_range when no part has that name
  void set(const std::string& name, bool on);
  /// The kernel file of the integrator.
  [[nodiscard]] const char* file() const;
  /// Macros for the kernels.
  [[nodiscard]] std::map<std::string, std::string> defines() const;
  /// The program of the kernel file `root`, or of the text `extra`, with these parts and users' files.
  /// @throws UsageError when a user's strategy cannot be read
  [[nodiscard]] device::ProgramSource source(const std::string& root, const std::string& extra = "") const;
};

/// A setting's radiance in the unit of the devices' sums, as tables::LightTable defines it.
/// @throws UsageError if single precision cannot hold it beside the scene's lights
[[nodiscard]] double in_units(const char* setting, double radiance, double unit);

/// WIDTH on a device. @throws UsageError for double precision with a WIDTH above 1, DeviceError for double
/// precision on a device without doubles
[[nodiscard]] int lanes_for(const device::DeviceInfo& device, const Settings& settings);

/// The parts of a render. @throws UsageError for an unknown integrator or strategy, and for settings that
/// cannot render this scene
[[nodiscard]] Parts find_parts(const scene::Scene& scene, const accel::Geometry& geometry,
                               const tables::LightTable& lights, const Settings& settings, int lanes);

} // namespace phlux::render
