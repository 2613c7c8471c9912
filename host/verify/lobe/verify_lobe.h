// Verification of any reflectance model, built-in or a user's, without closed forms.
#pragma once

#include "verify/lobe/cases.h"
#include "verify/verify.h"

namespace phlux::verify {

struct LobeToVerify {
  lobes::ModelPointer model;
  std::string strategy = "exact"; ///< of the phong model: a name, or a user's file
  std::string name;               ///< in the report
};

/// Records all checks of one model in `report`, without judging it. settings.strategies is not used.
/// @throws DeviceError when the kernels do not build, UsageError as lobes::assign
void check_lobe(const device::Device& device, const Settings& settings, const LobeToVerify& lobe,
                const Assignments& assignments, Report& report);

} // namespace phlux::verify
