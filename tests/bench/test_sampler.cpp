// `phlux bench sampling` against variances known by quadrature; coverage of its standard errors.
#include <catch2/catch.hpp>

#include "bench/sampling/sampler.h"
#include "render/render.h"

using namespace phlux;
using namespace phlux::bench;

namespace {

const device::Device& test_device() {
  static const device::Device device = device::open_devices({}).front();
  return device;
}

constexpr double sigmas = 4;

} // namespace

TEST_CASE("Variances agree with quadrature") {
  // The variance of one sample of the reflectivity.
  struct Known {
    Case one;
    double uniform, cosine, lobe_ks, lobe_rho, mixture;
  };
  const std::vector<Known> known = {
      {{.4, .05, 50, 30}, 0.125456, 0.026823, 0.241243, 0.247084, 0.246900},
      {{.4, .05, 50, 85}, 0.051849, 0.003204, 0.236758, 0.246387, 0.243692},
      {{.4, .4, 10, 60}, 0.324622, 0.221324, 0.165507, 0.290892, 0.275923},
      {{.1, .8, 90, 30}, 21.864599, 12.407981, 0.073705, 0.166876, 0.166749},
  };
  const std::vector<std::pair<std::string, double Known::*>> strategies = {{"uniform", &Known::uniform},
                                                                           {"cosine", &Known::cosine},
                                                                           {"lobe-ks", &Known::lobe_ks},
                                                                           {"lobe-rho", &Known::lobe_rho},
                                                                           {"mixture", &Known::mixture}};
  for (const int lanes : {1, 16})
    for (const auto& [strategy, variance] : strategies) {
      Sampler sampler(test_device(), {}, strategy, lanes);
      for (const Known& row : known) {
        CAPTURE(lanes, strategy, row.one.exponent, row.one.degrees);
        const auto run = sampler.run(row.one, 1 << 20, {{7, 7}});
        const measure::Moments m = moments_of(run.sums);
        CHECK(run.sums.count >= 1 << 20);
        CHECK(run.defects == 0);
        CHECK(std::abs(m.variance - row.*variance) < sigmas * m.variance_standard_error);
        CHECK(std::abs(bias_in_sigmas(m, exact_reflectivity(row.one))) < sigmas);
      }
    }
}

TEST_CASE("exact: the variance is that of the roulette, and all rays have weight 1") {
  Sampler sampler(test_device(), {}, "exact", 0);
  for (const Case& one :
       {Case{.4, .05, 50, 85}, Case{.4, .4, 10, 80}, Case{.1, .8, 1e4, 60}, Case{0, .9, 1, 30}}) {
    CAPTURE(one.exponent, one.degrees);
    const auto run = sampler.run(one, 1 << 20, {{3, 1}});
    const measure::Moments m = moments_of(run.sums);
    const double share = static_cast<double>(run.rays) / static_cast<double>(run.sums.count);
    CHECK(m.mean == Approx(share).epsilon(1e-5)); // weight 1
    CHECK(m.variance == Approx(share * (1 - share)).epsilon(1e-4));
    CHECK(static_cast<double>(run.draws) < 1.3 * static_cast<double>(run.sums.count));
  }
}

TEST_CASE("The standard error of the mean has the right coverage") {
  constexpr int seeds = 200;
  const Case one{.4, .4, 10, 60};
  const double exact = exact_reflectivity(one);
  for (const std::string strategy : {"cosine", "lobe-ks", "mixture", "exact"}) {
    Sampler sampler(test_device(), {}, strategy, 0);
    int within_one = 0, within_two = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const auto run = sampler.run(one, 1, {{static_cast<cl_uint>(seed), 1}});
      const double bias = std::abs(bias_in_sigmas(moments_of(run.sums), exact));
      within_one += bias < 1 ? 1 : 0;
      within_two += bias < 2 ? 1 : 0;
    }
    // 68.27% and 95.45% of 200 with binomial standard deviations of 6.6 and 2.9.
    CAPTURE(strategy);
    CHECK(std::abs(within_one - 136.5) < 3.3 * 6.6);
    CHECK(std::abs(within_two - 190.9) < 3.3 * 2.9);
  }
}

TEST_CASE("Samples of later launches continue the sequence; another seed is another sequence") {
  Sampler sampler(test_device(), {}, "lobe-ks", 0);
  const Case one{.4, .4, 10, 60};
  const auto half = sampler.run(one, 1, {{5, 5}});
  const std::uint32_t next = sampler.samples_per_lane(1);
  const auto other_half = sampler.run(one, 1, {{5, 5}}, next);
  const auto both = sampler.run(one, 2 * half.sums.count, {{5, 5}});
  CHECK(both.sums.count == 2 * half.sums.count);
  CHECK(both.rays == half.rays + other_half.rays);
  CHECK(both.sums.d2 ==
        Approx(half.sums.d2 + other_half.sums.d2).epsilon(1e-6)); // blocks are summed in float
  CHECK(sampler.run(one, 1, {{5, 6}}).sums.d != half.sums.d);
}

TEST_CASE("The printed estimate is biased, the corrected one is not") {
  const Case one{.4, .4, 10, 80}; // loses 28.5% of the specular part
  const double specular = exact_reflectivity(one) - one.diffuse;
  Sampler printed(test_device(), {}, "lobe-estimate-printed", 0),
      guarded(test_device(), {}, "lobe-estimate", 0);
  const measure::Moments p = moments_of(printed.run(one, 1 << 22, {{1, 1}}).sums);
  CHECK(bias_in_sigmas(p, exact_reflectivity(one)) < -10);
  CHECK((p.mean - one.diffuse) / specular ==
        Approx(1 - 0.285).margin(sigmas * p.mean_standard_error / specular));
  const measure::Moments g = moments_of(guarded.run(one, 1 << 22, {{1, 1}}).sums);
  CHECK(std::abs(bias_in_sigmas(g, exact_reflectivity(one))) < sigmas);
}

TEST_CASE("Every strategy can be built, an unknown one is an error") {
  for (const std::string& strategy : render::strategy_names())
    CHECK(Sampler(test_device(), {}, strategy, 0).run({.4, .4, 10, 60}, 1, {{1, 1}}).defects == 0);
  CHECK_THROWS_WITH(Sampler(test_device(), {}, "magic", 0), Catch::Contains("magic"));
}
