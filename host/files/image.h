// An image as files hold it: named float32 channels and what is known about the render.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "film/film.h"
#include "settings/settings.h"

namespace phlux::files {

/// Samples [first, end) of every pixel, as a seed makes them; of some pixels without the last ones where time
/// or a signal ended the render.
struct SampleRange {
  std::uint64_t seed = 0;
  std::int64_t first = 0, end = 0;
  bool operator==(const SampleRange&) const = default;
};

/// The attributes of CONTRACT.md, by their names there. In EXR files the texts and the seed (64 bits, which
/// no number of EXR holds) are strings, the others doubles. Each setting is there by its name, as maxDepth.
struct RenderInfo {
  std::string version;      ///< of phlux; empty in a file that another program wrote
  std::string scene;        ///< the file, as the user named it
  std::string scene_digest; ///< scene::digest
  /// Those that affect the image's expectation or its estimate, by name; in a merged image texts such as
  /// "path, bidir" where they differ.
  std::map<std::string, settings::Value> settings;
  double samples = 0.0; ///< per pixel, a mean where pixels differ
  std::uint64_t seed = 0;
  std::vector<SampleRange> ranges; ///< several in a merged image, of which `seed` is the first's
  std::string device, driver;
  double seconds = 0.0;       ///< of rendering
  double clamped_share = 0.0; ///< of the light, that clamping took away

  /// Of a setting; empty where it is absent or not known.
  [[nodiscard]] std::string text(const std::string& setting) const;
};

/// Whether images say it: RenderInfo::settings.
[[nodiscard]] bool is_stored(const settings::Setting& setting);
/// Those of a render.
[[nodiscard]] std::map<std::string, settings::Value> stored(const settings::Settings& settings);

struct Image {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels; ///< each width * height values, row by row from the top
  RenderInfo info;
};

/// Channels R, G, B: mean radiance, linear, neither exposed nor clamped. With `moments` also variance.R,
/// variance.G and variance.B: the variance of that mean; and reliability, see film::reliability_map.
[[nodiscard]] Image image_of(const film::Film& film, const RenderInfo& info, bool moments);

} // namespace phlux::files
