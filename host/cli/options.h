// What the user asked for on the command line.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"

namespace phlux::cli {

/// Options of `phlux render`; what is absent is the scene's to say.
struct RenderOptions {
  std::filesystem::path scene_file;
  std::map<std::string, std::string> definitions;

  std::optional<std::string> integrator, strategy;
  std::optional<render::Connect> connect;
  std::optional<render::LightSelection> light_selection;
  std::optional<int> connections;
  std::optional<render::Weights> weights;
  std::optional<int> max_depth, rr_depth;
  std::optional<double> ambient, clamp;

  std::optional<int> samples_per_pixel;
  std::optional<double> time_limit, target_error;
  std::optional<std::array<int, 2>> size; ///< width, height
  std::uint64_t seed = 0;

  std::vector<std::string> devices;
  int lanes = 0; ///< 0: what suits the device
  bool double_precision = false;
  render::Traversal traversal = render::Traversal::automatic;
  std::filesystem::path kernel_dir;

  std::filesystem::path output;  ///< empty: the scene's name, .exr, in the working directory
  std::filesystem::path preview; ///< empty: the output's name, .png, beside it
  std::filesystem::path statistics;
  std::filesystem::path contributions; ///< folder, empty: none
  bool moments = false, advise = false, quiet = false, verbose = false;
};

struct CompareOptions {
  std::filesystem::path a, b;
  bool json = false;
};

struct DevicesOptions {
  bool json = false;
};

struct VerifyOptions {
  std::vector<std::string> devices;    ///< one at most
  std::vector<std::string> strategies; ///< empty: all
  int lanes = 0;                       ///< 0: what suits the device
  std::size_t samples = 0;             ///< per case; 0: the default
  std::filesystem::path kernel_dir, json;
  bool quick = false;
};

} // namespace phlux::cli
