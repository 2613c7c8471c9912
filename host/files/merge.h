// Merges several renders of a scene into one image.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "files/image.h"

namespace phlux::files {

/// Weights images by their samples. The result has the radiance channels and, if all images have them, those
/// of the variance of the mean: sum (n_i / N)^2 var(m_i) for means m_i of n_i independent samples, N in all.
class Merger {
public:
  /// @throws FileError for an image without the attributes of a render; and for one that differs from those
  /// before in size, scene, light that is found, bias (with `clamp`: in the method) or a setting that affects
  /// the expectation, or shares samples with them
  void add(const std::string& name, const Image& image);
  /// The merged image of at least one. Attributes that differ become lists; samples and seconds are added.
  [[nodiscard]] Image result() const;
  /// Warnings about a result that is correct but not as good, or not as complete, as it could be.
  [[nodiscard]] std::vector<std::string> notes() const;

private:
  struct Source {
    std::string name;
    RenderInfo info;
    bool variance = false;
  };
  // Samples that two images share would count twice, and the variance would be wrong.
  class TakenSamples {
  public:
    // Logarithmic in the number of ranges. @throws FileError if some of the samples are taken
    void add(const std::string& name, const SampleRange& range);

  private:
    struct Range {
      std::int64_t end;
      std::string name;
    };
    std::map<std::pair<std::uint64_t, std::int64_t>, Range> ranges_; // by seed and first sample; disjoint
  };
  void check(const Source& source, const Image& image) const;

  int width_ = 0, height_ = 0;
  std::vector<Source> sources_;
  std::set<std::string> left_out_; // channels
  TakenSamples taken_;
  std::array<std::vector<double>, 3> radiance_, variance_; // weighted sums
};

} // namespace phlux::files
