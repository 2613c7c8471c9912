#include "verify/lobe/contradictions.h"

#include <algorithm>

#include <fmt/format.h>

#include "lobes/models.h"

namespace phlux::verify {
namespace {

struct Meaning {
  const char* check;
  const char* text; ///< {0}: the model, {1}: in capitals
};

constexpr Meaning meanings[] = {
    {"evaluate finite", "{0}_evaluate returns values that are not finite, or negative"},
    {"sample finite", "{0}_sample returns values that are not finite, or negative, or no draws"},
    {"reflectivity finite", "{0}_reflectivity returns values that are not finite, or negative"},
    {"unit", "{0}_sample's directions are not of unit length"},
    {"delta declared", "{0}_sample returns delta events, and {1}_HAS_DELTA 1 is not declared"},
    {"isotropy", "{0}_evaluate depends on the longitude, and {1}_NEEDS_TANGENTS 1 is not declared"},
    {"reciprocity", "{0}_evaluate's f_r changes where the two directions are swapped: it is not reciprocal"},
    {"reverse", "{0}_evaluate's `reverse` is not its `density` for swapped directions"},
    {"quadrature",
     "{0}_evaluate varies too fast to be integrated, so that the checks of its integrals say nothing: choose "
     "less extreme parameters"},
    {"normalised", "{0}_evaluate's density does not integrate to the share of samples that have a density"},
    {"directions", "{0}_sample's directions do not follow {0}_evaluate's density: one of them is wrong"},
    {"stated density", "{0}_sample states another density than {0}_evaluate has for the same directions"},
    {"jacobian",
     "{0}_sample states another density than its own map of random numbers has, by finite differences"},
    {"weights", "{0}_sample's weights are not f_r cos / density of {0}_evaluate"},
    {"means", "the mean of {0}_sample's weights is not the integral of {0}_evaluate's f_r cos"},
    {"reflectivity", "{0}_reflectivity is not the integral of {0}_evaluate's f_r cos (and delta events)"},
    {"weights' mean", "the mean of {0}_sample's weights is not {0}_reflectivity"},
    {"roulette",
     "the mean of {0}_sample's weights changes with roulette: {1}_SURVIVAL is no probability above 0"},
    {"energy", "{0}_evaluate reflects more than arrives"},
};

const Result* find(const Report& report, const std::string& name, const char* check) {
  const auto found = std::ranges::find_if(
      report.results(), [&](const Result& r) { return r.strategy == name && r.check == check; });
  return found == report.results().end() ? nullptr : &*found;
}

} // namespace

std::vector<std::string> explain(Report& report, const std::string& name, const std::string& model) {
  for (Result& result : report.results())
    for (const auto& [check, text] : meanings)
      if (!result.passed && result.strategy == name && result.check == check)
        result.note = fmt::format(fmt::runtime(text), model, lobes::macro_prefix(model));
  const auto fails = [&](const char* check) {
    const Result* result = find(report, name, check);
    return result != nullptr && !result->passed;
  };
  const auto passes = [&](const char* check) {
    const Result* result = find(report, name, check);
    return result != nullptr && result->passed;
  };
  std::vector<std::string> conclusions;
  const auto alone = [&](const std::string& function, const std::string& others) {
    conclusions.push_back(fmt::format("{} agree: {} is the one to look at", others, function));
  };
  const std::string evaluate = model + "_evaluate", sample = model + "_sample",
                    reflectivity = model + "_reflectivity";
  if (fails("means") && fails("reflectivity") && passes("weights' mean"))
    alone(evaluate + "'s f_r", sample + " and " + reflectivity);
  if (fails("reflectivity") && fails("weights' mean") && passes("means")) {
    if (fails("energy") || fails("reciprocity") || fails("evaluate finite"))
      conclusions.push_back(fmt::format(
          "{} fails checks of its own: look at it first, though {} agrees with it", evaluate, sample));
    else
      alone(reflectivity, evaluate + " and " + sample);
  }
  if (fails("means") && fails("weights' mean") && passes("reflectivity")) {
    const std::string others = evaluate + "'s f_r and " + reflectivity;
    if (!fails("normalised"))
      alone(sample, others);
    else if (fails("directions"))
      conclusions.push_back(
          fmt::format("{} agree: look at {}'s density and {}'s directions, which contradict each other",
                      others, evaluate, sample));
  }
  if (fails("normalised") && passes("directions"))
    conclusions.push_back(evaluate + "'s density has the right shape and the wrong scale");
  return conclusions;
}

} // namespace phlux::verify
