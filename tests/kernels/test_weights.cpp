// MIS weights of bidirectional path tracing: they sum to 1 over the techniques, and follow from the
// densities.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "device_test.h"
#include "directions.h"

using namespace device_test;

namespace {

constexpr std::size_t most_edges = 8;

struct GivenPath {
  float forward[most_edges + 1], backward[most_edges + 1], cosine_before[most_edges + 1],
      cosine_after[most_edges + 1];
  float distance2[most_edges];
  float film, chosen, emission;
  int hittable;
  int delta[most_edges + 1];
};
struct TechniqueWeights {
  float of[most_edges + 1];
};

const char* const heuristics[] = {"WEIGHTS_BALANCE", "WEIGHTS_POWER", "WEIGHTS_UNIFORM"};

// Densities are spread over `octaves` to either side of 1.
// With probability `delta` a vertex has a delta event, of whose densities only the ratio matters.
GivenPath random_path(Random& random, double octaves, bool hittable, double delta = 0) {
  const auto density = [&] { return static_cast<float>(std::exp2(random.uniform(-octaves, octaves))); };
  const auto cosine = [&] { return static_cast<float>(random.uniform(0.01, 1)); };
  GivenPath path{};
  for (std::size_t i = 0; i <= most_edges; ++i) {
    path.forward[i] = density();
    path.backward[i] = density();
    path.cosine_before[i] = cosine();
    path.cosine_after[i] = cosine();
  }
  for (float& distance2 : path.distance2) distance2 = density();
  path.film = density();
  path.chosen = density();
  path.emission = density();
  path.hittable = hittable;
  for (std::size_t i = 1; i <= most_edges && delta > 0; ++i) path.delta[i] = random.uniform(0, 1) < delta;
  return path;
}

// Density of a path, per area of every vertex except the eye, by the technique with s light vertices: the
// product of the densities of its vertices (Veach 1997, 10.2.1). Logarithms, as products exceed the range of
// double.
double log_density(const GivenPath& p, std::size_t edges, std::size_t s) {
  double sum = 0;
  const auto times = [&](double factor) { sum += std::log(factor); };
  const auto to_area = [&](double cosine, std::size_t edge) { return cosine / p.distance2[edge]; };
  for (std::size_t i = s; i < edges; ++i) { // sampled from the eye; the last edge by the film
    const double density = i + 1 == edges ? p.film : p.backward[i + 1];
    times(density * to_area(p.cosine_after[i], i));
  }
  if (s == 1) times(p.chosen * to_area(p.cosine_after[0], 0));
  if (s >= 2) {
    // The first two together: per area and projected solid angle, which is cos cos / d^2 per area of both.
    times(static_cast<double>(p.emission) * p.cosine_after[0] * to_area(p.cosine_before[1], 0));
    for (std::size_t i = 2; i < s; ++i) times(p.forward[i - 1] * to_area(p.cosine_before[i], i - 1));
  }
  return sum;
}

// Whether the technique can make the path: no subpath ends at a delta event, and a light that is hit has a
// surface.
bool is_possible(const GivenPath& path, std::size_t edges, std::size_t s) {
  if (s == 0) return path.hittable != 0;
  return path.delta[s - 1] == 0 && (s == edges || path.delta[s] == 0);
}

// Weights of all techniques, from their definition; empty if there is no technique.
std::vector<double> weights_of(const GivenPath& path, std::size_t edges, std::size_t heuristic) {
  std::vector<double> logs;
  for (std::size_t s = 0; s <= edges; ++s)
    logs.push_back(is_possible(path, edges, s) ? log_density(path, edges, s) : -INFINITY);
  if (*std::max_element(logs.begin(), logs.end()) == -INFINITY) return {};
  const double power = heuristic == 0 ? 1 : 2, largest = *std::max_element(logs.begin(), logs.end());
  std::vector<double> weights;
  double sum = 0;
  for (const double log : logs) {
    weights.push_back(heuristic == 2 ? (std::isinf(log) ? 0.0 : 1.0) : std::exp(power * (log - largest)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<TechniqueWeights> weigh(Variant v, std::size_t heuristic, const std::vector<GivenPath>& paths,
                                    std::size_t edges, bool has_delta = false) {
  std::vector<TechniqueWeights> weights(paths.size());
  program_of("weights.cl", v, {{"WEIGHTS", heuristics[heuristic]}, {"HAS_DELTA", has_delta ? "1" : "0"}})
      .run("weigh", paths.size(), paths, static_cast<int>(edges), out(weights));
  return weights;
}

} // namespace

TEST_CASE("weights: over all techniques they sum to 1, and each is what the densities say") {
  for (const Variant v : variants)
    for (std::size_t heuristic = 0; heuristic < 3; ++heuristic)
      for (const auto& [hittable, delta] : {std::pair(true, 0.0), {false, 0.0}, {true, 0.4}, {false, 0.2}}) {
        Random random(111);
        std::vector<GivenPath> paths;
        for (std::size_t i = 0; i < thinned(1000); ++i)
          paths.push_back(random_path(random, 3, hittable, delta));
        for (std::size_t edges = hittable ? 1 : 2; edges <= most_edges; ++edges) {
          CAPTURE(v, heuristics[heuristic], hittable, delta, edges);
          const auto weights = weigh(v, heuristic, paths, edges, delta > 0);
          double worst_sum = 0, worst_weight = 0;
          for (std::size_t i = 0; i < paths.size(); ++i) {
            const auto right = weights_of(paths[i], edges, heuristic);
            if (right.empty()) continue;
            double sum = 0;
            for (std::size_t s = 0; s <= edges; ++s) {
              const double weight = weights[i].of[s];
              sum += weight;
              worst_weight =
                  std::max(worst_weight, std::isfinite(weight) ? std::abs(weight - right[s]) : INFINITY);
            }
            worst_sum = std::max(worst_sum, std::abs(sum - 1));
          }
          CHECK(worst_sum <= 1e-5);
          CHECK(worst_weight <= 1e-5);
        }
      }
}

// Densities and lengths from 1e-18 to 1e18: their squares and products exceed the range of float32.
TEST_CASE("weights: extreme densities give weights from 0 to 1, and none that is not a number") {
  for (const Variant v : variants)
    for (std::size_t heuristic = 0; heuristic < 3; ++heuristic) {
      Random random(112);
      std::vector<GivenPath> paths;
      for (std::size_t i = 0; i < thinned(1000); ++i)
        paths.push_back(random_path(random, random.uniform(20, 60), i % 2 == 0));
      for (std::size_t edges = 2; edges <= most_edges; ++edges) {
        CAPTURE(v, heuristics[heuristic], edges);
        int wrong = 0;
        for (const TechniqueWeights& weights : weigh(v, heuristic, paths, edges))
          for (std::size_t s = 0; s <= edges; ++s) wrong += !(weights.of[s] >= 0 && weights.of[s] <= 1);
        CHECK(wrong == 0);
      }
    }
}

// A lobe of exponent 1e30, the largest: the square of its density exceeds the range of float32.
TEST_CASE("weights: a lobe that is nearly a delta distribution") {
  for (const Variant v : variants)
    for (std::size_t heuristic = 0; heuristic < 3; ++heuristic) {
      Random random(113);
      std::vector<GivenPath> paths;
      for (std::size_t i = 0; i < thinned(1000); ++i) {
        GivenPath path = random_path(random, 3, true);
        const std::size_t narrow = 1 + i % 3;
        path.forward[narrow] *= static_cast<float>(std::exp2(random.uniform(66, 97)));
        path.backward[narrow] = path.forward[narrow] * static_cast<float>(random.uniform(0.1, 10));
        paths.push_back(path);
      }
      for (std::size_t edges = 4; edges <= most_edges; ++edges) {
        CAPTURE(v, heuristics[heuristic], edges);
        const auto weights = weigh(v, heuristic, paths, edges);
        double worst = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
          const auto right = weights_of(paths[i], edges, heuristic);
          for (std::size_t s = 0; s <= edges; ++s)
            worst = std::max(worst, std::isfinite(weights[i].of[s]) ? std::abs(weights[i].of[s] - right[s])
                                                                    : INFINITY);
        }
        CHECK(worst <= 1e-5);
      }
    }
}
