// Verification of any reflectance model: shipped models pass, and a mistake in a function fails the check for
// it, which names the function.
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "errors.h"
#include "own_lobe.h"
#include "temporary_folder.h"
#include "verify/lobe/contradictions.h"
#include "verify/lobe/verify_lobe.h"
#include "verify/meanings.h"

using namespace phlux;

namespace {

struct Verified {
  verify::Report report;
  std::vector<std::string> conclusions;

  [[nodiscard]] std::string failures() const {
    std::string text;
    for (const verify::Result& r : report.results())
      if (!r.passed) text += r.check + " " + std::to_string(r.worst) + " (" + r.where + "): " + r.note + "\n";
    for (const std::string& conclusion : conclusions) text += conclusion + "\n";
    return text;
  }
  [[nodiscard]] const verify::Result* find(const std::string& check) const {
    const auto found = std::ranges::find(report.results(), check, &verify::Result::check);
    return found == report.results().end() ? nullptr : &*found;
  }
};

Verified run_quick(const lobes::ModelPointer& model, const verify::Assignments& assignments = {},
                   const std::string& strategy = "exact", int lanes = 4) {
  static const device::Device device = device::open_devices({}).front();
  verify::Settings settings;
  settings.lanes = lanes;
  settings.quick = true;
  Verified verified;
  verify::check_lobe(device, settings, {model, strategy, model->name}, assignments, verified.report);
  verified.report.judge();
  verified.conclusions = verify::explain(verified.report, model->name, model->name);
  return verified;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

Verified run_user_model(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  folder.write(name + ".cl", text);
  lobes::Library library;
  library.add(folder / (name + ".cl"));
  return run_quick(library.find(name));
}
Verified run_minnaert(const std::string& from = "", const std::string& to = "") {
  return run_user_model("minnaert", replaced(minnaert_text, from, to));
}

} // namespace

TEST_CASE("verify: every model that ships passes without closed forms", "[slow]") {
  const lobes::Library shipped;
  for (const lobes::ModelPointer& model : shipped.models())
    for (const int lanes : {1, 16}) {
      const bool made_of_others =
          model->name.ends_with("plastic") ||
          (model->name.starts_with("anisotropic") && model->name != "anisotropicphong");
      if (lanes == 1 && made_of_others) continue;
      CAPTURE(model->name, lanes);
      const bool rough = model->name.starts_with("rough");
      const verify::Assignments ggx = {{"distribution", "1"}}; // neither end of the range
      const Verified verified = run_quick(model, rough ? ggx : verify::Assignments(), "exact", lanes);
      CHECK(verified.failures() == "");
      CHECK(verified.report.p_values() > 5);
    }
}

TEST_CASE("verify: a user's own model passes all checks", "[slow]") {
  const Verified verified = run_minnaert();
  CHECK(verified.failures() == "");
  for (const char* check :
       {"evaluate finite", "sample finite", "reflectivity finite", "unit", "delta declared", "isotropy",
        "reciprocity", "reverse", "quadrature", "normalised", "directions", "stated density", "jacobian",
        "weights", "means", "reflectivity", "weights' mean", "roulette", "energy"}) {
    CAPTURE(check);
    REQUIRE(verified.find(check) != nullptr);
    CHECK(verified.find(check)->seen > 0);
    CHECK(verify::meaning_of(*verified.find(check)) != "");
  }
}

TEST_CASE("verify: parameters that are set are verified beside the defaults and the ends of ranges",
          "[slow]") {
  const Verified set =
      run_quick(lobes::shipped("phong"), {{"exponent", "90"}, {"specularReflectance", "0.1,0.4,0.2"}});
  CHECK(set.failures() == "");
  CHECK_THROWS_AS(run_quick(lobes::shipped("phong"), {{"exponents", "90"}}), UsageError);
  const auto materials = verify::materials_of(lobes::shipped("phong"), {{"exponent", "90"}});
  CHECK(materials.size() == 6);
  CHECK(materials[1].name == "exponent 90");
  for (const auto& each : materials) CHECK(lobes::largest_reflectance(each.material) <= 1);
}

TEST_CASE("verify: the phong model by one of its strategies", "[slow]") {
  for (const char* strategy : {"cosine", "lobe-rho", "fold", "mixture"}) {
    CAPTURE(strategy);
    CHECK(run_quick(lobes::shipped("phong"), {}, strategy).failures() == "");
  }
}

TEST_CASE("verify: a mistake in a function fails the check that names it", "[slow]") {
  struct Mistake {
    std::string what, from, to, check, note;
  };
  const Mistake mistakes[] = {
      {"evaluate scaled", "(0.5f * INV_PI) * power", "INV_PI * power", "weights",
       "minnaert_sample's weights are not f_r cos / density of minnaert_evaluate"},
      {"evaluate scaled", "(0.5f * INV_PI) * power", "INV_PI * power", "reflectivity",
       "minnaert_reflectivity is not the integral of minnaert_evaluate's f_r cos"},
      {"more than arrives", "0.8, 0, 1,", "0.8, 0, 1.5,", "energy",
       "minnaert_evaluate reflects more than arrives"},
      {"density scaled", "return (m.exponent + 2.0f)", "return (m.exponent + 1.0f)", "normalised",
       "minnaert_evaluate's density does not integrate to"},
      {"density of another shape", "v.density = minnaert_density(m, generated.z)",
       "v.density = larger(generated.z, (Real)(0.0f)) * INV_PI", "directions",
       "minnaert_sample's directions do not follow minnaert_evaluate's density"},
      {"reverse of the wrong direction", "v.reverse = minnaert_density(m, fixed.z)",
       "v.reverse = minnaert_density(m, generated.z)", "reverse", "minnaert_evaluate's `reverse`"},
      {"sample biased", "cosine_power_direction(m.exponent + 1.0f,", "cosine_power_direction(m.exponent,",
       "directions", "minnaert_sample's directions do not follow minnaert_evaluate's density"},
      {"sample biased", "cosine_power_direction(m.exponent + 1.0f,", "cosine_power_direction(m.exponent,",
       "jacobian", "minnaert_sample states another density than its own map"},
      {"stated density", "s.density = (0.5f", "s.density = (0.4f", "stated density",
       "minnaert_sample states another density than minnaert_evaluate"},
      {"weights", "s.weight = vec_scale(", "s.weight = vec_scale(0.9f * ", "means",
       "the mean of minnaert_sample's weights is not the integral of minnaert_evaluate's f_r cos"},
      {"not of unit length", "  s.delta = NO_LANES;",
       "  s.direction = vec_scale((Real)(1.001f), s.direction);\n  s.delta = NO_LANES;", "unit",
       "minnaert_sample's directions are not of unit length"},
      {"reflectivity", "return vec_scale(minnaert_power(fixed.z, m.exponent)",
       "return vec_scale(minnaert_power(fixed.z, m.exponent + 1.0f)", "weights' mean",
       "the mean of minnaert_sample's weights is not minnaert_reflectivity"},
      {"not reciprocal", "minnaert_power(fixed.z, m.exponent) * minnaert_power(generated",
       "minnaert_power(generated", "reciprocity", "minnaert_evaluate's f_r changes"},
      {"undeclared delta events", "s.delta = NO_LANES", "s.delta = ALL_LANES", "delta declared",
       "MINNAERT_HAS_DELTA 1 is not declared"},
      {"not finite at an end of a range", "(m.exponent + 2.0f) * (0.5f * INV_PI) * power",
       "1.0f / m.exponent * power", "evaluate finite",
       "minnaert_evaluate returns values that are not finite"},
      {"tangents", "const Real power =", "const Real power = (1.0f + fixed.x * generated.x) *", "isotropy",
       "MINNAERT_NEEDS_TANGENTS 1 is not declared"},
      {"roulette", "LOBE_STRUCT(", "#define MINNAERT_SURVIVAL(m, fixed, random) (Real)(0.0f)\nLOBE_STRUCT(",
       "roulette", "changes with roulette"},
  };
  for (const Mistake& m : mistakes) {
    CAPTURE(m.what, m.check);
    const Verified verified = run_minnaert(m.from, m.to);
    INFO(verified.failures());
    REQUIRE(verified.find(m.check) != nullptr);
    CHECK_FALSE(verified.find(m.check)->passed);
    CHECK(verified.find(m.check)->note.find(m.note) != std::string::npos);
  }
}

TEST_CASE("verify: of three functions the one that contradicts two is named", "[slow]") {
  CHECK(
      run_minnaert("(0.5f * INV_PI) * power", "INV_PI * power").conclusions ==
      std::vector<std::string>{
          "minnaert_sample and minnaert_reflectivity agree: minnaert_evaluate's f_r is the one to look at"});
  CHECK(
      run_minnaert("s.weight = vec_scale(", "s.weight = vec_scale(0.9f * ").conclusions ==
      std::vector<std::string>{
          "minnaert_evaluate's f_r and minnaert_reflectivity agree: minnaert_sample is the one to look at"});
  CHECK(run_minnaert("return vec_scale(minnaert_power(fixed.z, m.exponent)",
                     "return vec_scale(minnaert_power(fixed.z, m.exponent + 1.0f)")
            .conclusions ==
        std::vector<std::string>{
            "minnaert_evaluate and minnaert_sample agree: minnaert_reflectivity is the one to look at"});
  const std::string brighter = replaced(minnaert_text, "const Real power = ", "const Real power = 1.5f * ");
  CHECK(
      run_user_model("minnaert", replaced(brighter, "s.weight = vec_scale(", "s.weight = vec_scale(1.5f * "))
          .conclusions ==
      std::vector<std::string>{"minnaert_evaluate fails checks of its own: look at it first, though "
                               "minnaert_sample agrees with it"});
  CHECK(run_minnaert("return (m.exponent + 2.0f)", "return (m.exponent + 1.0f)").conclusions ==
        std::vector<std::string>{"minnaert_evaluate's density has the right shape and the wrong scale"});
  const std::string retro =
      TemporaryFolder::read(std::filesystem::path(PHLUX_SOURCE_DIR) / "scenes/lobes/retro.cl");
  CHECK(run_user_model("retro", replaced(retro, "0.5f * (m.exponent + 1.0f) * power",
                                         "0.5f * (m.exponent + 2.0f) * power"))
            .conclusions ==
        std::vector<std::string>{"retro_evaluate's density has the right shape and the wrong scale"});
  CHECK(run_user_model("retro", replaced(retro, "cosine_power_direction(m.exponent,",
                                         "cosine_power_direction(m.exponent + 1.0f,"))
            .conclusions ==
        std::vector<std::string>{
            "retro_evaluate's f_r and retro_reflectivity agree: look at retro_evaluate's density "
            "and retro_sample's directions, which contradict each other"});
}

// Exercise 1 of Shirley's and Ashikhmin's chapter on reflection models: with which C does f_r = C cos^a theta
// conserve energy, if theta is the angle of one of the two directions? It reflects C pi cos^a(theta) if that
// direction is known, and C 2 pi / (a + 2) if light arrives from the other. Exercise 2 asks for a reciprocal
// one: minnaert_text, which passes all checks.
TEST_CASE("verify: of a power of one cosine, the energy that it conserves, and that it is not reciprocal",
          "[slow]") {
  const std::string both = "minnaert_power(fixed.z, m.exponent) * minnaert_power(generated.z, m.exponent)";
  struct Case {
    std::string cosine, scale;
    bool conserves_energy;
  };
  const Case cases[] = {{"fixed", "INV_PI", true},
                        {"fixed", "(m.exponent + 2.0f) * (0.5f * INV_PI)", false},
                        {"generated", "(m.exponent + 2.0f) * (0.5f * INV_PI)", true},
                        {"generated", "1.01f * (m.exponent + 2.0f) * (0.5f * INV_PI)", false}};
  for (const Case& c : cases) {
    CAPTURE(c.cosine, c.scale);
    std::string text = replaced(minnaert_text, both, "minnaert_power(" + c.cosine + ".z, m.exponent)");
    text = replaced(text, "v.value = vec_scale((m.exponent + 2.0f) * (0.5f * INV_PI)",
                    "v.value = vec_scale(" + c.scale);
    const Verified verified = run_user_model("minnaert", text);
    INFO(verified.failures());
    CHECK(verified.find("energy")->passed == c.conserves_energy);
    CHECK_FALSE(verified.find("reciprocity")->passed);
  }
}
