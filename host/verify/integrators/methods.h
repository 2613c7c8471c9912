// The integrators and their variants that are verified.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/techniques.h"
#include "settings/settings.h"

namespace phlux::verify {

/// An integrator with one of its variants.
struct Method {
  std::string name;            ///< in the report: "path mis", "light", "bidir balance"
  settings::Settings settings; ///< integrator, variant and depth
  std::string variant;    ///< the setting that a user chooses it by, such as "`connect` none"; may be empty
  std::string look_at;    ///< the kernel function that is most likely wrong if this method is
  int samples = 0;        ///< per pixel and render of the furnace
  int glossy_samples = 0; ///< of the glossy furnace; 0: it is not rendered
  bool quick = false;     ///< verified with Settings::quick too
};

/// All variants that have programs of their own. The last one has each technique of bidir apart.
[[nodiscard]] const std::vector<Method>& methods();
/// The method of this name; null if there is none.
[[nodiscard]] const Method* find_method(const std::string& name);

// Checks of the method with techniques apart.
inline constexpr int technique_edges = 6;                             ///< of the longest paths
[[nodiscard]] std::string check_of(const film::Technique& technique); ///< "s2-t3": alone, without weights
[[nodiscard]] std::string check_of_length(int edges); ///< "5 edges": the weighted sum over their techniques
/// The technique of such a check; nothing for others.
[[nodiscard]] std::optional<film::Technique> technique_of(const std::string& check);
/// Whether it is a check of check_of_length.
[[nodiscard]] bool is_length(const std::string& check);
/// The kernel function that makes such paths.
[[nodiscard]] std::string function_of(const film::Technique& technique);
/// The techniques that make paths of so many edges, by their number of light vertices.
[[nodiscard]] std::vector<film::Technique> techniques_of(int edges);

} // namespace phlux::verify
