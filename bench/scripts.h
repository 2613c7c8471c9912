// The Python programs that the build put into this binary.
#pragma once

#include <string_view>

namespace phlux::bench {

/// bench/figures.py
[[nodiscard]] std::string_view figures_script();
/// bench/chart_style.py, which the others import
[[nodiscard]] std::string_view chart_style_script();
/// bench/rays.py
[[nodiscard]] std::string_view rays_script();
/// bench/report.py
[[nodiscard]] std::string_view report_script();
/// bench/scenes.py
[[nodiscard]] std::string_view scenes_script();
/// bench/sampling.py
[[nodiscard]] std::string_view sampling_script();
/// bench/arithmetic.py
[[nodiscard]] std::string_view arithmetic_script();
/// bench/stability.py
[[nodiscard]] std::string_view stability_script();
/// bench/precision.py
[[nodiscard]] std::string_view precision_script();
/// bench/remedies.py
[[nodiscard]] std::string_view remedies_script();

} // namespace phlux::bench
