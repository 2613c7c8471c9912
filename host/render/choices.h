// What a user may choose of a render.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "render/render.h"

namespace phlux::render {

/// What is absent is the scene's to say, or has the default of Settings.
struct Choices {
  std::map<std::string, std::string> definitions; ///< of the scene's $names
  std::optional<std::array<int, 2>> size;         ///< width, height

  std::optional<std::string> integrator, strategy;
  std::optional<Connect> connect;
  std::optional<LightSelection> light_selection;
  std::optional<int> connections;
  std::optional<Weights> weights;
  std::optional<int> max_depth, rr_depth;
  std::optional<double> ambient, clamp;
  std::optional<std::uint64_t> seed;
  std::optional<std::int64_t> first_sample;
  std::optional<bool> double_precision;
  int lanes = 0; ///< 0: what suits the device
  Traversal traversal = Traversal::automatic;

  std::optional<int> samples_per_pixel;
  std::optional<double> time_limit, target_error;

  /// Chooses as `earlier` what is absent here. How much to render is one choice.
  void complete(const Choices& earlier);
};

} // namespace phlux::render
