// The list of settings, and how the settings of a render follow from choices, scene and defaults.
#include <set>

#include <catch2/catch.hpp>

#include "errors.h"
#include "settings/choices.h"

using namespace phlux;
using namespace phlux::settings;
using Catch::Contains;

namespace {

Choices chosen(const std::map<std::string, std::string>& texts) {
  Choices choices;
  for (const auto& [name, text] : texts) choices.choose(named(name), text);
  return choices;
}

// For each setting a valid value that is not the default, as text.
const std::map<std::string, std::string> other_texts = {{"integrator", "bidir"},
                                                        {"strategy", "cosine"},
                                                        {"connect", "light"},
                                                        {"weights", "power"},
                                                        {"light-selection", "power"},
                                                        {"connections", "0"},
                                                        {"contributions", "DIR"},
                                                        {"ambient", "0.1"},
                                                        {"clamp", "1e-30"},
                                                        {"max-depth", "12"},
                                                        {"rr-depth", "-1"},
                                                        {"roulette", "kd-ks"},
                                                        {"sampler", "lattice"},
                                                        {"spp", "2147483647"},
                                                        {"time", "0.3"},
                                                        {"error", "1e+20"},
                                                        {"crop", "4,5,7,3"},
                                                        {"threads", "2"},
                                                        {"seed", "18446744073709551615"},
                                                        {"first-sample", "7"},
                                                        {"width", "16"},
                                                        {"precision", "double"},
                                                        {"traversal", "bvh"}};

} // namespace

TEST_CASE("Every setting's value comes back from its text, and goes to no other setting") {
  std::set<std::string> names;
  for (const Setting& setting : all()) {
    CAPTURE(setting.name);
    CHECK(names.insert(setting.name).second);
    Settings changed;
    setting.read(other_texts.at(setting.name), changed);
    CHECK(setting.value(changed) != setting.value({}));
    CHECK(setting.text(changed) == other_texts.at(setting.name));
    for (const Setting& other : all())
      if (other.name != setting.name) CHECK(other.value(changed) == other.value({}));
    Settings back = changed;
    setting.copy({}, back);
    CHECK(setting.value(back) == setting.value({}));
  }
  CHECK(names.size() == other_texts.size());
}

TEST_CASE("An invalid value of a setting is refused with the name of the setting") {
  const auto refusal = [](const std::string& name, const std::string& text) -> std::string {
    try {
      chosen({{name, text}});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "nothing";
  };
  CHECK(refusal("seed", "-1") == "`seed` -1: must be a whole number from 0 to 18446744073709551615");
  CHECK(refusal("connect", "mos") == "`connect` mos: did you mean mis? It must be one of none, light, mis");
  CHECK(refusal("width", "3") == "`width` 3: must be one of 1, 4, 8, 16");
  CHECK(refusal("rr-depth", "0") == "`rr-depth` 0: must be a whole number of 1 or more, or -1 for unbounded");
  CHECK(refusal("clamp", "0") == "`clamp` 0: must be a number from 1e-30 to 1e+30");
  CHECK_THROWS_WITH(named("exposure"), "`exposure`: there is no such setting");
}

TEST_CASE("The user overrides the scene, and the scene the defaults") {
  const scene::RenderDefaults scene{
      .integrator = "bidir", .samples_per_pixel = 9, .max_depth = 8, .rr_depth = 3, .crop = {}};
  Settings defaults;
  defaults.seed = 5;
  defaults.max_depth = 2;
  const Settings both = settings_of(chosen({{"rr-depth", "7"}, {"connections", "1"}}), scene, defaults);
  CHECK(both.integrator == "bidir");
  CHECK(both.samples_per_pixel == 9);
  CHECK(both.max_depth == 8);
  CHECK(both.rr_depth == 7);
  CHECK(both.connections == 1);
  CHECK(both.seed == 5);
}

TEST_CASE("A choice that is of no use to the integrator is refused, saying why") {
  const auto refusal = [](const std::map<std::string, std::string>& texts, bool techniques = false) {
    Settings defaults;
    defaults.techniques = techniques;
    try {
      (void)settings_of(chosen(texts), {}, defaults);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  CHECK(refusal({{"connect", "mis"}}) == "nothing");
  CHECK(refusal({{"integrator", "light"}, {"connect", "mis"}}) ==
        "`connect` is for path only: light finds lights by other techniques");
  CHECK_THAT(refusal({{"weights", "power"}}), Contains("`weights` is for bidir only: path has"));
  CHECK_THAT(refusal({{"connections", "3"}}), Contains("`connections` is for bidir only: path connects"));
  CHECK_THAT(refusal({{"integrator", "bidir"}, {"connections", "3"}}, true),
             Contains("`contributions` needs every connection"));
  CHECK_THAT(refusal({{"connect", "none"}, {"light-selection", "power"}}),
             Contains("`light-selection` is for light samples"));
  CHECK(refusal({{"connect", "light"}, {"light-selection", "power"}}) == "nothing");
  CHECK_THAT(refusal({{"integrator", "bidir"}, {"ambient", "1"}}), Contains("`ambient` is for path only"));
  CHECK_THAT(refusal({{"roulette", "kd-ks"}, {"rr-depth", "-1"}}),
             Contains("`rr-depth` -1 there is no roulette"));
}

TEST_CASE("Earlier choices fill in what is absent; how much to render is one choice") {
  Choices earlier = chosen({{"spp", "16"}, {"seed", "3"}, {"width", "8"}, {"clamp", "2"}, {"threads", "2"}});
  earlier.definitions = {{"a", "1"}, {"b", "2"}};
  earlier.size = {4, 5};
  Choices now = chosen({{"time", "9"}, {"clamp", "1"}});
  now.definitions = {{"a", "3"}};
  now.complete(earlier);
  CHECK(now.texts ==
        std::map<std::string, std::string>{{"time", "9"}, {"clamp", "1"}, {"seed", "3"}, {"width", "8"}});
  CHECK(now.definitions == std::map<std::string, std::string>{{"a", "3"}, {"b", "2"}});
  CHECK(now.size == earlier.size);

  Choices in_double = chosen({{"precision", "double"}});
  in_double.complete(earlier);
  CHECK_FALSE(in_double.has("width"));
  CHECK(in_double.texts.at("spp") == "16");
}

TEST_CASE("Integrators and strategies are found by their names") {
  for (const IntegratorInfo& info : integrators) {
    CHECK(&integrator_named(info.name) == &info);
    CHECK(&info_of(info.integrator) == &info);
  }
  for (const Strategy& each : strategies) CHECK(strategy("`strategy`", each.name) == each.name);
  CHECK_THROWS_WITH(integrator_named("photons"), Contains("`integrator` photons: must be one of path"));
  CHECK_THROWS_WITH(strategy("`strategy`", "guess"), Contains("`strategy` guess: must be one of uniform"));
  CHECK(strategy("`strategy`", "fold") == "fold");
  CHECK(strategy("`strategy`", "of/my/own.cl") == "of/my/own.cl"); // which need not exist yet
  CHECK_THROWS_WITH(strategy("`strategy`", "fould"), Contains("`strategy` fould: did you mean fold?"));
  CHECK_THROWS_WITH(read_strategy("none.cl"), Contains("`strategy` none.cl: cannot be read"));
}
