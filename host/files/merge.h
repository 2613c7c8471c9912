// One image of several renders of a scene.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "files/image.h"

namespace phlux::files {

/// Weighs images by their samples, one after the other. The result has the radiance channels and, where all
/// images have them, those of the variance of the mean, which for means m_i of n_i independent samples, N in
/// all, is sum (n_i / N)^2 var(m_i).
class Merger {
public:
  /// @throws FileError for an image that does not go with those before: of another size, scene or depth,
  /// clamped otherwise, or with samples that one of them has; and for one that does not say what it has
  void add(const std::string& name, const Image& image);
  /// Of at least one image. Its attributes are those of the first where images agree, lists where not, sums
  /// of samples and seconds.
  [[nodiscard]] Image result() const;
  /// What a user should know of the result though it is right.
  [[nodiscard]] std::vector<std::string> notes() const;

private:
  struct Source {
    std::string name;
    RenderInfo info;
    bool variance = false;
  };
  void check(const Source& source, const Image& image) const;

  int width_ = 0, height_ = 0;
  std::vector<Source> sources_;
  std::array<std::vector<double>, 3> radiance_, variance_; // weighted sums; no variance_ once one has none
};

} // namespace phlux::files
