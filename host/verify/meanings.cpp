#include "verify/meanings.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "verify/integrators/methods.h"
#include "verify/strategy.h"

namespace phlux::verify {
namespace {

struct Meaning {
  const char* check;
  const char* text;
  const char* function; ///< {0}: the file of phong_sample, {1}: that of phong_density
};

constexpr const char *sampling = "phong_sample ({0})", *density = "phong_density ({1})",
                     *lobe_value = "phong_lobe (kernels/phong/phong.cl)",
                     *lobe_sum = "phong_lobe_reflectivity (kernels/phong/phong.cl)";

constexpr Meaning of_strategies[] = {
    {"directions", "sampled directions against the density, over cells of the sphere (chi-square)", sampling},
    {"means", "mean weight of the samples against the reflectivity, per channel", sampling},
    {"pooled means", "mean weights over all cases together against the reflectivity, in standard errors",
     sampling},
    {"mean, long", "mean weight over more samples of four materials, in standard errors", sampling},
    {"variance", "variance of a weight against its closed form, in standard errors", sampling},
    {"weights", "weight of a sample against f_r cos / (density x survival), relative", sampling},
    {"weight 1", "weights of grey materials with roulette, which are 1: largest error", sampling},
    {"bounds", "largest weight, as a part of its bound", sampling},
    {"unit", "length of a direction, which is 1: largest error", sampling},
    {"finite", "number of samples that are not finite, or negative", sampling},
    {"densities", "density that a sample states against float64, relative", density},
    {"edge", "error of densities and weights near alpha = 90 degrees, in units of float32's", density},
    {"both roles", "density and reverse density with either direction fixed, relative", density},
    {"jacobian", "density against finite differences of the sampler, in units of their error", density},
    {"partial", "sampled against integrated f_r cos over squares of (x, y) (chi-square)", sampling},
    {"evaluated", "evaluated against integrated f_r cos over squares of (x, y), relative", lobe_value},
    {"sum", "sum over the squares against the reflectivity function, relative",
     "phong_reflectivity (kernels/phong/phong.cl)"},
    {"loss as derived", "energy that is lost against its closed form, in standard errors",
     "one_sample_estimate (kernels/phong/estimate.h)"},
    {"loss as known", "closed form of that loss against published figures, in units of their last digit",
     ""}};

constexpr Meaning of_model[] = {
    {"reflectivity", "reflectivity function against quadrature, relative", lobe_sum},
    {"energy", "largest reflectivity where kd + ks = 1", lobe_sum},
    {"reciprocity", "f_r with its directions exchanged, relative", lobe_value},
    {"value", "f_r against float64, relative", lobe_value},
    {"value at edge", "f_r near alpha = 90 degrees against float64, in units of float32's error", lobe_value},
    {"below", "f_r of directions below the surface, which is 0",
     "material_evaluate (kernels/lobes/material.cl)"},
    {"known values", "f_r against figures in closed form", "phong_value (kernels/phong/phong.cl)"},
    {"known reflectivities", "reflectivity against figures in closed form, relative", lobe_sum},
    {"quadrature", "this program's own quadrature against the same figures", ""}};

constexpr Meaning of_lobes[] = {
    {"evaluate finite", "number of values that are not finite, or negative", ""},
    {"sample finite", "number of samples that are not finite, or negative", ""},
    {"reflectivity finite", "number of reflectivities that are not finite, or negative", ""},
    {"unit", "length of a direction, which is 1: largest error", ""},
    {"delta declared", "number of delta events, if none are declared", ""},
    {"isotropy", "f_r and density at other longitudes, if tangents are not needed, relative", ""},
    {"reciprocity", "f_r with its directions exchanged, relative", ""},
    {"reverse", "reverse density against the density with exchanged directions, relative", ""},
    {"quadrature", "estimated error of the integrals over the hemisphere, relative", ""},
    {"normalised", "integral of the density against the share of samples with a density", ""},
    {"directions", "sampled directions against the density, over cells of the hemisphere (chi-square)", ""},
    {"stated density", "density that a sample states against that of evaluate, relative", ""},
    {"jacobian", "density against finite differences of the sampler, relative", ""},
    {"weights", "weight of a sample against f_r cos / density, relative", ""},
    {"means", "mean weight of the samples against the integral of f_r cos", ""},
    {"reflectivity", "reflectivity function against the integral of f_r cos, relative", ""},
    {"weights' mean", "mean weight of the samples against the reflectivity function", ""},
    {"roulette", "mean weight with and without roulette", ""},
    {"energy", "largest reflected fraction", ""}};

constexpr Meaning of_integrators[] = {
    {"finite", "number of contributions that are not finite", ""},
    {"furnace", "mean radiance in a closed room of albedo a that emits 1, which is 1 / (1 - a) (t-test)", ""},
    {"glossy furnace", "mean radiance of a Phong ball there, by paths of up to 3 edges (t-test)",
     "material_evaluate (kernels/lobes/material.cl)"}};

std::span<const Meaning> meanings(Kind kind) {
  switch (kind) {
  case Kind::model:
    return of_model;
  case Kind::strategy:
    return of_strategies;
  case Kind::integrator:
    return of_integrators;
  case Kind::lobe:
    break;
  }
  return of_lobes;
}

const Meaning* find(const Result& result) {
  const auto list = meanings(kind_of(result));
  const auto found =
      std::ranges::find_if(list, [&](const Meaning& meaning) { return result.check == meaning.check; });
  return found == list.end() ? nullptr : &*found;
}

const Strategy* find_strategy(const std::string& name) {
  const auto found = std::ranges::find(strategies(), name, &Strategy::name);
  return found == strategies().end() ? nullptr : &*found;
}

std::string file_of_samples(const Strategy& strategy) {
  return strategy.family == Family::smooth  ? "kernels/phong/plain.cl"
         : strategy.family == Family::whole ? "kernels/phong/strategies/" + strategy.name + ".cl"
                                            : "kernels/phong/one_part.cl";
}
std::string file_of_densities(const Strategy& strategy) {
  return strategy.family == Family::whole ? "kernels/phong/whole.h" : file_of_samples(strategy);
}

} // namespace

Kind kind_of(const Result& result) {
  if (result.strategy.empty()) return Kind::model;
  if (find_method(result.strategy)) return Kind::integrator;
  return find_strategy(result.strategy) ? Kind::strategy : Kind::lobe;
}

std::string meaning_of(const Result& result) {
  if (const Meaning* meaning = find(result)) return meaning->text;
  if (technique_of(result.check)) return "mean radiance by one technique alone, without its weight (t-test)";
  if (is_length(result.check))
    return "mean radiance of such paths by all of their techniques, weighted (t-test)";
  return "";
}

std::string function_to_look_at(const Result& result) {
  if (!result.look_at.empty()) return result.look_at;
  const Meaning* meaning = find(result);
  if (kind_of(result) == Kind::integrator) {
    if (const auto technique = technique_of(result.check)) return function_of(*technique);
    return meaning && *meaning->function ? meaning->function : find_method(result.strategy)->look_at;
  }
  if (!meaning) return "";
  const Strategy* strategy = find_strategy(result.strategy);
  return strategy ? fmt::format(fmt::runtime(meaning->function), file_of_samples(*strategy),
                                file_of_densities(*strategy))
                  : meaning->function;
}

} // namespace phlux::verify
