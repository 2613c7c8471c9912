// Checks of the integrators: the mean radiance of furnaces (furnace.h), by each method and technique.
#pragma once

#include <string>
#include <vector>

#include "device/device.h"
#include "verify/report.h"
#include "verify/verify.h"

namespace phlux::verify {

/// Renders the furnaces by the methods of the chosen integrators, many times with different seeds, and
/// records p-values of Student's t-test of the means against the known radiance: "furnace" and "glossy
/// furnace", and for techniques those of check_of and check_of_length. A method that seems wrong is rendered
/// again with paths of limited lengths, and a note says from which length on it is wrong. @throws DeviceError
void check_integrators(const device::Device& device, const Settings& settings, Report& report);

/// A line for each integrator that failed, once the report is judged: what not to use on this device, and
/// why.
[[nodiscard]] std::vector<std::string> integrators_not_to_use(const Report& report);

} // namespace phlux::verify
