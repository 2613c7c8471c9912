// The Python programs that the build put into this binary.
#pragma once

#include <string_view>

namespace phlux::bench {

/// bench/figures/figures.py
[[nodiscard]] std::string_view figures_script();
/// bench/common/report/chart_style.py, which the others import
[[nodiscard]] std::string_view chart_style_script();
/// bench/rays/rays.py
[[nodiscard]] std::string_view rays_script();
/// bench/common/report/report.py
[[nodiscard]] std::string_view report_script();
/// bench/scenes/scenes.py
[[nodiscard]] std::string_view scenes_script();
/// bench/sampling/sampling.py
[[nodiscard]] std::string_view sampling_script();
/// bench/arithmetic/arithmetic.py
[[nodiscard]] std::string_view arithmetic_script();
/// bench/stability/stability.py
[[nodiscard]] std::string_view stability_script();
/// bench/precision/precision.py
[[nodiscard]] std::string_view precision_script();
/// bench/remedies/remedies.py
[[nodiscard]] std::string_view remedies_script();

} // namespace phlux::bench
