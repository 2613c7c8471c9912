#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verify/integrators/check_integrators.h"
#include "verify/integrators/methods.h"

namespace phlux::verify {
namespace {

// Failures of techniques say most, then those with a note.
int rank(const Result& result) {
  if (find_method(result.strategy)->settings.techniques) return 2;
  return result.note.empty() ? 0 : 1;
}

// The failure of a method that says most; null if it passed.
const Result* failure_of(const Report& report, const Method& method) {
  const Result* reason = nullptr;
  for (const Result& result : report.results())
    if (result.strategy == method.name && !result.passed && (!reason || rank(result) > rank(*reason)))
      reason = &result;
  return reason;
}

bool was_verified(const Report& report, const Method& method) {
  return std::ranges::find(report.results(), method.name, &Result::strategy) != report.results().end();
}

std::string reason_of(const Result& result) {
  if (result.check == "finite") return fmt::format("{:g} contributions are not finite", result.worst);
  if (technique_of(result.check)) return fmt::format("technique {} is {}", result.check, result.where);
  if (is_length(result.check)) return fmt::format("paths of {} are {}", result.check, result.where);
  return fmt::format("the {} is {}{}{}", result.check, result.where, result.note.empty() ? "" : "; ",
                     result.note);
}

} // namespace

std::vector<std::string> integrators_not_to_use(const Report& report) {
  std::vector<std::string> lines;
  for (const std::string& integrator : settings::integrator_names()) {
    std::vector<std::string> wrong; // variants that failed
    bool all = true;
    const Result* reason = nullptr;
    for (const Method& method : methods()) {
      if (method.settings.integrator != integrator || !was_verified(report, method)) continue;
      const Result* failure = failure_of(report, method);
      if (failure) wrong.push_back(method.variant);
      if (failure && (!reason || rank(*failure) > rank(*reason))) reason = failure;
      if (method.settings.techniques)
        all |= failure != nullptr; // every variant uses the techniques
      else
        all &= failure != nullptr;
    }
    if (reason)
      lines.push_back(fmt::format("do not use `integrator` {}{} on this device: {}", integrator,
                                  all ? "" : fmt::format(" with {}", fmt::join(wrong, " or ")),
                                  reason_of(*reason)));
  }
  return lines;
}

} // namespace phlux::verify
