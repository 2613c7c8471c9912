// Float32 against float64: how far images of the same samples are apart, against noise, and what it costs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/common/methods/image_estimates.h"
#include "bench/common/options.h"
#include "film/film.h"

namespace phlux::bench {

struct PrecisionOptions : CommonOptions {    ///< lanes: beside 1
  std::vector<std::filesystem::path> scenes; ///< empty: those that ship, with those of scenes/stability
  bool quick = false;                        ///< path tracing of scenes/ alone, fewer samples
  std::uint64_t seed = 1;
  std::function<bool()> interrupted; ///< may be empty
};

/// Samples per pixel whose statistical error is the unit of the error of float32.
inline constexpr double unit_samples = 4096;

/// How renders in float32 differ from those of the same seeds in float64. An error is the root mean square
/// over pixels and channels in the measure of files::compare, in units of the statistical error of
/// unit_samples.
struct PrecisionError {
  double variance = 0;   ///< of one sample, relative
  double difference = 0; ///< of two images of unit_samples and one seed: what is systematic, and samples that
                         ///< took another way
  double systematic = 0, systematic_most = 0; ///< that more samples do not lessen; two standard errors above
  Figure mean;        ///< relative difference of the images' means; 0 +- its standard error where all is well
  double largest = 0; ///< of a value in its own standard error at unit_samples, where it has noise
  double quiet_share = 0;      ///< of the values, those without noise: whose standard error is below 1e-6
  double quiet_difference = 0; ///< the largest relative difference among those
};

/// Pairs of renders of one scene: pair i in both precisions from one seed. At least three, of as many samples
/// each.
struct PrecisionPairs {
  std::vector<ImageEstimate> single, in_double;
  std::vector<double> variance; ///< of each value's mean over all renders in double, as films say
};

[[nodiscard]] PrecisionPairs pairs_of(const std::vector<film::Film>& single,
                                      const std::vector<film::Film>& in_double);

[[nodiscard]] PrecisionError precision_error(const PrecisionPairs& pairs);

/// Samples per pixel in double beyond which an image in double has less error than one in single of the same
/// time, where single is `times_as_fast`: the systematic error is what the additional samples take away.
/// Infinite where there is no systematic error, 0 where single is no faster.
[[nodiscard]] double break_even_samples(double systematic, double times_as_fast);

[[nodiscard]] const std::vector<std::string>& precision_columns();

/// Measures and writes precision.csv as it goes, then its charts and its section of the report. Returns false
/// when interrupted. @throws UsageError, SceneError, DeviceError (also where the device has no doubles),
/// WriteError
[[nodiscard]] bool measure_precision(const PrecisionOptions& options);

} // namespace phlux::bench
