// Contributions by technique (Veach 10.2), for teaching and debugging.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace phlux::film {

/// The technique (s, t): s vertices of the light subpath, t of the eye subpath.
struct Technique {
  int light_vertices = 0, eye_vertices = 0;
  [[nodiscard]] int edges() const { return light_vertices + eye_vertices - 1; }
  auto operator<=>(const Technique&) const = default;

  template<class Archive>
  void serialize(Archive& archive) {
    archive(light_vertices, eye_vertices);
  }
};

/// Techniques of longer paths are not recorded: each takes two images.
inline constexpr int most_technique_edges = 8;

class Techniques {
public:
  /// Sums over all paths, row by row from the top.
  struct Sums {
    std::vector<std::array<double, 3>> weighted, unweighted;
    std::uint64_t contributions = 0; ///< occluded ones included: the shadow rays, where s > 0
  };
  static constexpr double bytes_per_pixel = 2 * 3 * sizeof(double); ///< of one technique

  explicit Techniques(std::size_t pixels = 0) : pixels_(pixels) {}

  /// Adds the unweighted contribution of one path to a pixel, and its product with the MIS weight `weight`.
  void add(Technique technique, std::size_t pixel, const std::array<double, 3>& radiance, double weight);
  [[nodiscard]] const std::map<Technique, Sums>& sums() const { return sums_; }
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; } ///< contributions of longer paths

  template<class Archive>
  void serialize(Archive& archive) {
    auto count = static_cast<std::uint16_t>(sums_.size());
    archive(count);
    auto each = sums_.begin();
    for (std::uint16_t i = 0; i < count; ++i) {
      Technique technique = each == sums_.end() ? Technique() : (each++)->first;
      archive(technique);
      Sums& sums = sums_[technique];
      for (auto* image : {&sums.weighted, &sums.unweighted}) {
        image->resize(pixels_);
        for (std::array<double, 3>& pixel : *image) archive(pixel);
      }
      archive(sums.contributions);
    }
    archive(left_out_);
  }

private:
  std::size_t pixels_;
  std::map<Technique, Sums> sums_;
  std::uint64_t left_out_ = 0;
};

} // namespace phlux::film
