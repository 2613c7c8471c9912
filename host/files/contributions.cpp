#include "files/contributions.h"

#include <algorithm>
#include <array>
#include <regex>

#include <fmt/format.h>

#include "files/canvas.h"
#include "files/exr.h"
#include "files/output.h"
#include "files/png.h"
#include "files/tone_map.h"

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

// Images downsampled by a whole factor to about 128 pixels across, each below its (s,t): a row per number of
// edges, a column per s.
class Sheet {
public:
  Sheet(int width, int height, int most_edges)
      : width_(width), factor_((std::max(width, height) + largest_tile - 1) / largest_tile),
        tile_width_(std::max(width / factor_, 1)), tile_height_(std::max(height / factor_, 1)),
        text_scale_(tile_width_ >= largest_tile / 2 ? 2 : 1), rows_(most_edges) {}

  void put(Technique technique, const Pixels& pixels, bool weighted) {
    Tile tile{technique, weighted, blank(tile_width_, tile_height_, {})};
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (int y = 0; y < tile_height_; ++y)
        for (int x = 0; x < tile_width_; ++x)
          tile.image.channels[radiance_names[channel]][index(x, y, tile_width_)] =
              static_cast<float>(mean_of(pixels, x * factor_, y * factor_, channel));
    tiles_.push_back(std::move(tile));
  }

  // All tiles have the same exposure.
  [[nodiscard]] Canvas picture() const {
    const int line = Canvas::text_height(text_scale_) + text_scale_;
    const int column = std::max(tile_width_, Canvas::text_width("(0,0)", text_scale_)) + gap;
    const int row = line + tile_height_ + gap, half = (rows_ + 1) * column + gap;
    Canvas canvas(2 * half + gap, line + gap + rows_ * row + gap, paper);
    canvas.text(gap, gap, "weighted", ink, text_scale_);
    canvas.text(gap + half, gap, "unweighted", ink, text_scale_);
    const float exposed = exposure(all_tiles());
    for (const Tile& tile : tiles_) {
      const int s = tile.technique.light_vertices, t = tile.technique.eye_vertices;
      const int left = gap + s * column + (tile.weighted ? 0 : half),
                top = line + 2 * gap + (tile.technique.edges() - 1) * row;
      canvas.text(left, top, fmt::format("({},{})", s, t), ink, text_scale_);
      draw_image(canvas, left, top + line, 1, tile.image, exposed);
    }
    return canvas;
  }

private:
  struct Tile {
    Technique technique;
    bool weighted;
    Image image;
  };
  static constexpr int largest_tile = 128, gap = 6;

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

  // One below the other.
  [[nodiscard]] Image all_tiles() const {
    Image all = blank(tile_width_, 0, {});
    for (const Tile& tile : tiles_) {
      all.height += tile_height_;
      for (const char* name : radiance_names) {
        const std::vector<float>& values = tile.image.channels.at(name);
        all.channels[name].insert(all.channels[name].end(), values.begin(), values.end());
      }
    }
    return all;
  }

  int width_, factor_, tile_width_, tile_height_, text_scale_, rows_;
  std::vector<Tile> tiles_;
};

constexpr const char* sheet_name = "contributions.png";

bool has_name_of_contribution(const std::filesystem::path& file) {
  static const std::regex image(R"(s\d+-t\d+(-unweighted)?\.exr)");
  const std::string name = file.filename().string();
  return name == sheet_name || std::regex_match(name, image);
}

// Removes the images of an earlier render, which may have had techniques that this one has not.
void remove_earlier(const std::filesystem::path& folder) {
  std::error_code none;
  std::vector<std::filesystem::path> earlier;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (has_name_of_contribution(entry.path()) && entry.is_regular_file(none))
      earlier.push_back(entry.path());
  for (const std::filesystem::path& file : earlier) std::filesystem::remove(file, none);
}

} // namespace

Canvas contact_sheet(film::Film& film) {
  const auto& techniques = film.techniques()->sums();
  int most_edges = 1;
  for (const auto& [technique, sums] : techniques) most_edges = std::max(most_edges, technique.edges());
  Sheet sheet(film.width(), film.height(), most_edges);
  for (const auto& [technique, sums] : techniques)
    for (const bool weighted : {true, false})
      sheet.put(technique, film.technique_image(weighted ? sums.weighted : sums.unweighted), weighted);
  return sheet.picture();
}

void check_contributions_writable(const std::filesystem::path& folder) {
  make_folder(folder);
  check_writable(folder / sheet_name);
}

NonFinite write_contributions(const std::filesystem::path& folder, film::Film& film, const RenderInfo& info,
                              const film::Progress& progress) {
  make_folder(folder);
  remove_earlier(folder);
  NonFinite not_finite;
  const auto& all = film.techniques()->sums();
  double done = 0.0;
  for (const auto& [technique, sums] : all) {
    if (progress) progress(done++ / static_cast<double>(all.size()));
    const std::string name = fmt::format("s{}-t{}", technique.light_vertices, technique.eye_vertices);
    for (const bool weighted : {true, false}) {
      const Pixels pixels = film.technique_image(weighted ? sums.weighted : sums.unweighted);
      for (const auto& [channel, count] : write_exr(folder / (name + (weighted ? ".exr" : "-unweighted.exr")),
                                                    image_of(pixels, film.width(), film.height(), info)))
        not_finite[channel] += count;
    }
  }
  write_file(folder / sheet_name, encode_png(contact_sheet(film)));
  return not_finite;
}

bool is_contribution(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto canonical = [&](const std::filesystem::path& path) { // follows links as far as there are files
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const std::filesystem::path there = canonical(file);
  return !file.empty() && !error && has_name_of_contribution(there) &&
         there.parent_path() == canonical(folder);
}

} // namespace phlux::files
