#include "files/contributions.h"

#include <algorithm>
#include <array>
#include <regex>

#include <fmt/format.h>

#include "errors.h"
#include "files/exr.h"
#include "files/png.h"

namespace phlux::files {
namespace {

using film::Technique;
using Pixels = std::vector<std::array<double, 3>>;

Image blank(int width, int height, const RenderInfo& info) {
  Image image;
  image.width = width;
  image.height = height;
  image.info = info;
  for (const char* name : radiance_names)
    image.channels[name].resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return image;
}

Image image_of(const Pixels& pixels, int width, int height, const RenderInfo& info) {
  Image image = blank(width, height, info);
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
      image.channels[radiance_names[channel]][pixel] = static_cast<float>(pixels[pixel][channel]);
  return image;
}

// Images downsampled by a whole factor to about 128 pixels across: a row per number of edges, a column per s.
class Sheet {
public:
  Sheet(int width, int height, int most_edges, const RenderInfo& info)
      : width_(width), factor_((std::max(width, height) + largest_tile - 1) / largest_tile),
        tile_width_(std::max(width / factor_, 1)), tile_height_(std::max(height / factor_, 1)),
        columns_(most_edges + 1), image_(blank(2 * columns_ * (tile_width_ + gap) + gap,
                                               most_edges * (tile_height_ + gap) + gap, info)) {}

  void put(Technique technique, const Pixels& pixels, bool weighted) {
    const int column = technique.light_vertices + (weighted ? 0 : columns_);
    const int left = gap + column * (tile_width_ + gap),
              top = gap + (technique.edges() - 1) * (tile_height_ + gap);
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (int y = 0; y < tile_height_; ++y)
        for (int x = 0; x < tile_width_; ++x)
          image_.channels[radiance_names[channel]][index(left + x, top + y, image_.width)] =
              static_cast<float>(mean_of(pixels, x * factor_, y * factor_, channel));
  }

  [[nodiscard]] const Image& image() const { return image_; }

private:
  static constexpr int largest_tile = 128, gap = 4;

  static std::size_t index(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  [[nodiscard]] double mean_of(const Pixels& pixels, int left, int top, std::size_t channel) const {
    double sum = 0;
    for (int y = 0; y < factor_; ++y)
      for (int x = 0; x < factor_; ++x)
        sum += pixels[std::min(index(left + x, top + y, width_), pixels.size() - 1)][channel];
    return sum / (factor_ * factor_);
  }

  int width_, factor_, tile_width_, tile_height_, columns_;
  Image image_;
};

} // namespace

NonFinite write_contributions(const std::filesystem::path& folder, film::Film& film, const RenderInfo& info) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw WriteError(
        fmt::format("{}: cannot be made: {}: name another folder", folder.string(), failure.message()));
  const film::Techniques& techniques = *film.techniques();
  int most_edges = 1;
  for (const auto& [technique, sums] : techniques.sums())
    most_edges = std::max(most_edges, technique.edges());
  NonFinite not_finite;
  Sheet sheet(film.width(), film.height(), most_edges, info);
  for (const auto& [technique, sums] : techniques.sums()) {
    const std::string name = fmt::format("s{}-t{}", technique.light_vertices, technique.eye_vertices);
    for (const bool weighted : {true, false}) {
      const Pixels pixels = film.technique_image(weighted ? sums.weighted : sums.unweighted);
      for (const auto& [channel, count] : write_exr(folder / (name + (weighted ? ".exr" : "-unweighted.exr")),
                                                    image_of(pixels, film.width(), film.height(), info)))
        not_finite[channel] += count;
      sheet.put(technique, pixels, weighted);
    }
  }
  write_png(folder / "contributions.png", rows_of(sheet.image()));
  return not_finite;
}

bool is_contribution(const std::filesystem::path& folder, const std::filesystem::path& file) {
  static const std::regex name(R"(s\d+-t\d+(-unweighted)?\.exr|contributions\.png)");
  std::error_code error;
  const std::filesystem::path there = std::filesystem::canonical(file, error);
  return !error && std::regex_match(there.filename().string(), name) &&
         std::filesystem::equivalent(folder, there.parent_path(), error);
}

} // namespace phlux::files
