// `phlux bench sampling --lobe`: a user's reflectance model, by quadrature and by its samplers.
#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "bench/common/tables/saved_table.h"
#include "bench/sampling/quadrature.h"
#include "bench/sampling/sampler.h"
#include "bench/sampling/sampling.h"
#include "bench/sampling/sampling_table.h"
#include "lobes/assignment.h"
#include "phong/reflectivity.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

const device::Device& test_device() {
  static const auto& device = *new device::Device(device::open_devices({}).front());
  return device;
}

constexpr double share = 0.7;

std::shared_ptr<const scene::Material> retro(double exponent) {
  lobes::Library library;
  library.add(PHLUX_SOURCE_DIR "/scenes/lobes/retro.cl");
  scene::Material material = lobes::default_material(library.find("retro"));
  material.value("reflectance") = {0.9, 0.6, 0.3};
  material.value("share") = scene::Rgb(share);
  material.value("exponent") = scene::Rgb(exponent);
  return std::make_shared<const scene::Material>(material);
}

double closed_form(double exponent, double degrees) {
  const double rho = phong::lobe_reflectivity(exponent, std::cos(degrees * std::numbers::pi / 180));
  return 0.6 * (1 - share + share * rho);
}

} // namespace

TEST_CASE("Quadrature over the hemisphere finds lobes of every width") {
  for (const double exponent : {0.0, 1.0, 50.0, 1e4, 1e6})
    for (const double degrees : {0.0, 40.0, 85.0}) {
      CAPTURE(exponent, degrees);
      const double angle = degrees * std::numbers::pi / 180;
      const std::array<double, 3> axis{std::sin(angle), 0, std::cos(angle)};
      const auto evaluate = [&](const std::vector<float>& directions) {
        std::vector<float> values;
        for (std::size_t i = 0; i < directions.size(); i += 3) {
          double distance2 = 0;
          for (std::size_t k = 0; k < 3; ++k)
            distance2 += std::pow(static_cast<double>(directions[i + k]) - axis.at(k), 2);
          const double power = distance2 < 2 ? std::exp(exponent * std::log1p(-distance2 / 2)) : 0;
          values.push_back(static_cast<float>((exponent + 2) / (2 * std::numbers::pi) * power));
        }
        return values;
      };
      CHECK(hemisphere_integral(evaluate, {axis}) ==
            Approx(phong::lobe_reflectivity(exponent, std::cos(angle))).epsilon(1e-5));
    }
}

TEST_CASE("A model's own sampling, cosine and uniform have the mean that quadrature has") {
  constexpr double sigmas = 4.5; // of 24 means one is further off in 1 of 6000 runs
  for (const double exponent : {1.0, 30.0})
    for (const double degrees : {20.0, 80.0}) {
      const Case one{0, 0, 0, degrees, retro(exponent)};
      for (const std::string& strategy : strategies_of_model(*one.given->model))
        for (const int lanes : {1, 16}) {
          CAPTURE(exponent, degrees, strategy, lanes);
          Sampler sampler(test_device(), {}, strategy, lanes, one.given->model);
          const double reflected = sampler.reflectivity_of(one);
          CHECK(reflected == Approx(closed_form(exponent, degrees)).epsilon(1e-5));
          const Subject subject{one, Light::constant, has_roulette(strategy), reflected, {{3, 4}}};
          const auto run = sampler.run(subject, 1 << 18);
          CHECK(run.defects == 0);
          CHECK(std::abs(bias_in_sigmas(moments_of(run.sums), reflected)) < sigmas);
        }
    }
}

// At normal incidence a sharp lobe lies above the surface, so that all samples that survive go on.
TEST_CASE("The exact split of anisotropicphong survives with its reflectivity, and keeps the mean") {
  constexpr double sigmas = 4.5; // of 8 figures one is further off in 1 of 18,000 runs
  scene::Material polish = lobes::anisotropic_phong(scene::Rgb(0.5), scene::Rgb(0.3), 1000, 100);
  for (const double degrees : {0.0, 70.0})
    for (const int lanes : {1, 16}) {
      CAPTURE(degrees, lanes);
      const Case one{0, 0, 0, degrees, std::make_shared<const scene::Material>(polish)};
      Sampler sampler(test_device(), {}, exact_split, lanes, polish.model);
      const double reflected = sampler.reflectivity_of(one);
      const auto run = sampler.run({one, Light::constant, true, reflected, {{5, 6}}}, 1 << 18);
      CHECK(run.defects == 0);
      CHECK(std::abs(bias_in_sigmas(moments_of(run.sums), reflected)) < sigmas);
      const double count = static_cast<double>(run.sums.count), share = static_cast<double>(run.rays) / count;
      if (degrees == 0)
        CHECK(std::abs(share - reflected) < sigmas * std::sqrt(reflected * (1 - reflected) / count) + 1e-5);
      Sampler estimated(test_device(), {}, polish.model->name, lanes, polish.model);
      const auto other = estimated.run({one, Light::constant, true, reflected, {{5, 6}}}, 1 << 18);
      if (degrees == 0)
        CHECK(std::abs(static_cast<double>(other.rays) / count - reflected) >
              5 * std::sqrt(reflected * (1 - reflected) / count));
    }
}

TEST_CASE("The tables of a model have its name, and no kd, ks or n") {
  const TemporaryFolder folder;
  SamplingOptions options;
  options.folder = folder.path();
  options.samples = 1 << 14;
  options.material = retro(30);
  REQUIRE(write_sampling_tables(options));
  const SavedTable table(folder.path(), "sampling-retro.csv", sampling_columns());
  REQUIRE(table.rows().size() == 3 * std::size(model_angles));
  for (const SavedTable::Row& row : table.rows()) {
    for (const char* column : {"kd", "ks", "n"}) CHECK(table.value(row, column).empty());
    CHECK(table.value(row, "integrand") == "constant");
    CHECK(table.value(row, "defects") == "0");
    CHECK(std::stod(table.value(row, "exact")) ==
          Approx(closed_form(30, std::stod(table.value(row, "theta_deg")))).epsilon(1e-5));
  }
  CHECK(table.rows()[0].front() == "retro");
  CHECK(table.rows()[1].front() == "cosine");
  CHECK(table.rows()[2].front() == "uniform");
  const SavedTable bare(folder.path(), "sampling-retro-no-roulette.csv", sampling_columns());
  CHECK(bare.rows().size() == std::size(model_angles)); // its own sampling alone
  CHECK_FALSE(folder.names().contains("sampling-retro-plain-roulette.csv"));
}
