// The options of each command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "settings/choices.h"

namespace phlux::cli {

/// Options of `phlux render`.
struct RenderOptions : settings::Choices {
  std::filesystem::path scene_file;
  std::vector<std::filesystem::path> lobes; ///< kernel files of the user's reflectance models
  std::vector<std::string> devices;
  std::filesystem::path kernel_dir;

  std::filesystem::path output;  ///< empty: the scene's name, .exr, in the working directory
  std::filesystem::path preview; ///< empty: the output's name, .png, beside it
  std::filesystem::path statistics;
  std::filesystem::path contributions; ///< folder, empty: none
  std::filesystem::path resume;        ///< empty: from the beginning
  std::filesystem::path checkpoint;    ///< empty: that of `resume`, if any
  std::optional<double> checkpoint_seconds;
  std::optional<double> memory;   ///< bytes that the film may take; absent: those available
  std::optional<double> exposure; ///< of the preview, in stops; absent: automatic
  std::vector<std::string> aov;   ///< names of files::aov_names
  bool moments = false, advise = false, quiet = false, verbose = false;
};

/// Options of `phlux info`: those of a render that decide on its kernel and memory.
struct InfoOptions : RenderOptions {
  bool json = false;
};

struct CompareOptions {
  /// The largest value of a metric, one of files::metric_names, that passes.
  struct Limit {
    std::string metric;
    double value = 0.0;
  };
  std::filesystem::path a, b;
  std::filesystem::path picture, page; ///< empty: none
  std::vector<Limit> limits;
  bool json = false;
};

struct MergeOptions {
  std::vector<std::filesystem::path> images;
  std::filesystem::path output;
};

struct ViewOptions {
  std::filesystem::path image;
  std::filesystem::path picture;  ///< empty: shown in tev
  std::optional<double> exposure; ///< of the picture, in stops; absent: automatic
  std::string tev;                ///< HOST:PORT
};

struct DevicesOptions {
  bool json = false;
};

struct VerifyOptions {
  std::vector<std::string> devices;                            ///< one at most
  std::vector<std::string> strategies;                         ///< names and kernel files
  std::vector<std::string> integrators;                        ///< names; empty, as strategies: all of both
  std::vector<std::filesystem::path> lobes;                    ///< kernel files of the user's models
  std::vector<std::string> models;                             ///< names of built-in models
  std::vector<std::pair<std::string, std::string>> parameters; ///< NAME and VALUE
  int lanes = 0;                                               ///< 0: the device's
  std::size_t samples = 0;                                     ///< per case; 0: the default
  std::filesystem::path kernel_dir, json;
  bool quick = false;
};

} // namespace phlux::cli
