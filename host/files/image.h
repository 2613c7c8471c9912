// An image as it is stored: named float32 channels and information about the render.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "film/film.h"
#include "film/first_hit.h"
#include "settings/settings.h"

namespace phlux::files {

/// Samples [first, end) of a seed in every pixel; some pixels lack the last ones if a time limit or a signal
/// ended the render.
struct SampleRange {
  std::uint64_t seed = 0;
  std::int64_t first = 0, end = 0;
  bool operator==(const SampleRange&) const = default;
};

/// The attributes of an image file. In EXR files texts and the seed are strings, as EXR has no 64-bit
/// integers; the others are doubles. Settings have their own names in camel case, such as maxDepth.
struct RenderInfo {
  std::string version;      ///< of phlux; empty in a file of another program
  std::string scene;        ///< the file, as the user named it
  std::string scene_digest; ///< scene::digest
  /// By name, those that affect the image's expectation or its estimate; lists such as "path, bidir" where
  /// the sources of a merged image differ.
  std::map<std::string, settings::Value> settings;
  std::string choice;              ///< why a render by `integrator` auto has these; else empty
  double samples = 0.0;            ///< per pixel; the mean if pixels differ
  std::uint64_t seed = 0;          ///< of the first range
  std::vector<SampleRange> ranges; ///< several in a merged image
  std::string device, driver;
  double seconds = 0.0;       ///< of rendering
  double clamped_share = 0.0; ///< share of the light that clamping removed
  std::string missed_light{}; ///< of the scene, that the integrator cannot find; empty: none
  /// Column and row of its upper left pixel in the image of which it is a part, and the size of that image;
  /// 0: it is whole.
  std::array<int, 2> origin{}, whole{};

  /// The attributes, channels or sizes in the file are not those that phlux wrote: it is damaged, or another
  /// program has changed the image and copied its attributes.
  bool is_changed = false;

  /// A setting as text; empty if it is absent.
  [[nodiscard]] std::string text(const std::string& setting) const;
};

/// Whether RenderInfo::settings has it.
[[nodiscard]] bool is_stored(const settings::Setting& setting);
/// RenderInfo::settings of a render.
[[nodiscard]] std::map<std::string, settings::Value> stored(const settings::Settings& settings);

using ChannelNames = std::array<const char*, 3>;
inline constexpr ChannelNames radiance_names = {"R", "G", "B"};
inline constexpr ChannelNames variance_names = {"variance.R", "variance.G", "variance.B"};
inline constexpr const char* reliability_name = "reliability";

struct Image {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels; ///< each width * height values, row by row from the top
  RenderInfo info;

  [[nodiscard]] bool has(const ChannelNames& names) const;
};

/// An image whose values are computed when they are written, so that they take no memory.
struct Rows {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  /// Writes the `width` values of a channel, an index into `channels`, in a row from the top.
  std::function<void(int row, std::size_t channel, float* to)> fill;
};

/// A row of the channels R, G and B.
class RadianceRow {
public:
  explicit RadianceRow(const Rows& rows);
  void read(int row); ///< into `values`
  std::array<std::vector<float>, 3> values;

private:
  const Rows& rows_;
  std::array<std::size_t, 3> channels_{};
};

/// `image` must live as long as the result.
[[nodiscard]] Rows rows_of(const Image& image);
/// The same rows, with `progress` called at the beginning of each.
[[nodiscard]] Rows with_progress(Rows rows, film::Progress progress);
/// The channels of image_of(film, ...). `film` must live as long as the result.
/// `progress`: of the computation of the reliability.
[[nodiscard]] Rows rows_of(const film::Film& film, bool moments, const film::Progress& progress = {});

/// The names of the first hits' values, each before the point of its channels.
inline const std::vector<std::string> aov_names = {"albedo", "normal", "depth"};
inline constexpr std::array<const char*, 7> first_hit_channels = {
    "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"};
inline constexpr std::array<const char*, 7> first_hit_variance_channels = {
    "variance.albedo.R", "variance.albedo.G", "variance.albedo.B", "variance.normal.X",
    "variance.normal.Y", "variance.normal.Z", "variance.depth.Z"};
/// Adds the channels of the names `aov` and their variances, one value per pixel each. `hits` must live as
/// long as the rows.
void add_first_hits(Rows& rows, const std::vector<film::FirstHit>& hits, const std::vector<std::string>& aov);

/// Channels R, G, B: mean radiance, linear, neither exposed nor clamped. With `moments` also variance.R, .G
/// and .B, the variance of that mean, and reliability, see film::reliability_map.
[[nodiscard]] Image image_of(const film::Film& film, const RenderInfo& info, bool moments);

} // namespace phlux::files
