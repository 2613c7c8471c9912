// The verification of any reflectance model, a user's own or one that ships, without closed forms.
#pragma once

#include "verify/lobe/cases.h"
#include "verify/verify.h"

namespace phlux::verify {

struct LobeToVerify {
  lobes::ModelPointer model;
  std::string strategy = "exact"; ///< of the phong model: a name, or a user's file
  std::string name;               ///< in the report
};

/// Sees all checks of one model into `report` and judges nothing. Of `settings` the strategies are not used.
/// @throws DeviceError where the kernels do not build, UsageError as lobes::assign
void see_lobe(const device::Device& device, const Settings& settings, const LobeToVerify& lobe,
              const Assignments& assignments, Report& report);

} // namespace phlux::verify
