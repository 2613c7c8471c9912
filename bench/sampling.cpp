#include "bench/sampling.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include <unistd.h>

#include <fmt/format.h>

#include "bench/csv.h"
#include "render/render.h"

namespace phlux::bench {
namespace {

constexpr int least_rounds = 5;
constexpr std::uint64_t largest_launch = std::uint64_t{1} << 23; // samples; the kernel counts in 32 bits
constexpr double proposals_for_full_count = 16; // beyond, `rejection` gets fewer samples by default

// What one row of the table says.
struct Row {
  Case one;
  std::string strategy;
  Sampler::Run run;
  std::vector<double> nanoseconds; // per sample, of each round

  [[nodiscard]] double per_sample(std::uint64_t count) const {
    return static_cast<double>(count) / static_cast<double>(run.sums.count);
  }
  [[nodiscard]] double median_nanoseconds() const {
    std::vector<double> sorted = nanoseconds;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
  }
  [[nodiscard]] double bias() const { return bias_in_sigmas(moments_of(run.sums), exact_reflectivity(one)); }
};

std::string line_of(const Row& row, const device::Device& device, int lanes, std::uint32_t seed) {
  const Moments m = moments_of(row.run.sums);
  const double rays = row.per_sample(row.run.rays), nanoseconds = row.median_nanoseconds();
  const auto [least, most] = std::ranges::minmax(row.nanoseconds);
  return fmt::format(
      "{},{},{},{},{},{},{:.9g},{:.9g},{:.4g},{:.8g},{:.4g},{:.6g},{:.5g},{:.6g},{:.6g},{:.6g},{},{},{:.5g},"
      "{:.5g},{},{},{}",
      row.strategy, row.one.diffuse, row.one.specular, row.one.exponent, row.one.degrees, row.run.sums.count,
      m.mean, exact_reflectivity(row.one), row.bias(), m.variance, m.variance_standard_error, rays,
      nanoseconds, m.variance * nanoseconds, m.variance * rays, row.per_sample(row.run.draws),
      has_roulette(row.strategy) ? 1 : 0, row.run.defects, least, most, seed, csv_value(device.info.name),
      lanes);
}

bool left_out(const std::string& strategy, const Case& one) {
  return strategy == "rejection" && rejection_proposals(one) > most_proposals;
}

std::uint64_t samples_of(const SamplingOptions& options, const std::string& strategy, const Case& one) {
  if (options.samples) return *options.samples;
  const std::uint64_t full = std::uint64_t{1} << (options.quick ? 20 : 22);
  if (strategy != "rejection") return full;
  const double share = std::min(1.0, proposals_for_full_count / rejection_proposals(one));
  return static_cast<std::uint64_t>(static_cast<double>(full) * share);
}

std::uint64_t launch_of(const std::string& strategy, const Case& one, std::uint64_t samples) {
  double most = static_cast<double>(largest_launch);
  if (strategy == "rejection") most *= std::min(1.0, proposals_for_full_count / rejection_proposals(one));
  return std::clamp<std::uint64_t>(samples / least_rounds, 1, static_cast<std::uint64_t>(most));
}

// One case, all strategies: a launch of each in turn until each has its samples.
std::vector<Row> measure(std::vector<Sampler>& samplers, const Case& one, const SamplingOptions& options,
                         std::uint32_t case_number) {
  std::vector<Row> rows;
  std::vector<Sampler*> at_work;
  for (Sampler& sampler : samplers)
    if (!left_out(sampler.strategy(), one)) {
      rows.push_back({one, sampler.strategy(), {}, {}});
      at_work.push_back(&sampler);
    }
  std::vector<std::uint32_t> first(rows.size(), 0);
  for (bool working = true; working;) {
    working = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Row& row = rows[i];
      const std::uint64_t wanted = samples_of(options, row.strategy, one);
      if (row.run.sums.count >= wanted && row.nanoseconds.size() >= least_rounds) continue;
      const std::uint64_t launch = launch_of(row.strategy, one, wanted);
      const cl_uint2 seed = {{options.seed, case_number * 64 + static_cast<cl_uint>(i)}};
      const Sampler::Run run = at_work[i]->run(one, launch, seed, first[i]);
      first[i] += at_work[i]->samples_per_lane(launch);
      row.nanoseconds.push_back(1e9 * run.seconds / static_cast<double>(run.sums.count));
      row.run.add(run);
      working = true;
    }
  }
  return rows;
}

// ---- What the user sees

class Progress {
public:
  explicit Progress(std::size_t cases) : cases_(cases), begin_(Clock::now()) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done) {
    if (!terminal_) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    std::string left;
    if (done > 0) {
      const auto rest =
          static_cast<int>(seconds * static_cast<double>(cases_ - done) / static_cast<double>(done));
      left = fmt::format("  {}:{:02} left", rest / 60, rest % 60);
    }
    fmt::print(stderr, "\r\033[K{} of {} cases{}", done, cases_, left);
  }

private:
  using Clock = std::chrono::steady_clock;
  void clear() const {
    if (terminal_) fmt::print(stderr, "\r\033[K");
  }
  std::size_t cases_;
  Clock::time_point begin_;
  bool terminal_ = isatty(STDERR_FILENO) != 0;
};

struct Summary {
  double largest_bias = 0;
  std::uint64_t defects = 0;
  std::size_t rows = 0;
  std::vector<double> relative_costs; // to lobe-ks in the same case
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void add(std::map<std::string, Summary>& summaries, const std::vector<Row>& rows) {
  const auto plain = std::ranges::find(rows, "lobe-ks", &Row::strategy);
  for (const Row& row : rows) {
    Summary& summary = summaries[row.strategy];
    if (std::abs(row.bias()) > std::abs(summary.largest_bias)) summary.largest_bias = row.bias();
    summary.defects += row.run.defects;
    ++summary.rows;
    if (plain != rows.end())
      summary.relative_costs.push_back(row.median_nanoseconds() / plain->median_nanoseconds());
  }
}

void print(const std::vector<std::string>& strategies, const std::map<std::string, Summary>& summaries,
           std::size_t cases) {
  fmt::print("{:<22} {:>6} {:>20} {:>8} {:>24}\n", "strategy", "cases", "largest bias / sigma", "defects",
             "time / lobe-ks (median)");
  for (const std::string& strategy : strategies) {
    const auto found = summaries.find(strategy);
    if (found == summaries.end()) continue;
    const Summary& s = found->second;
    fmt::print("{:<22} {:>6} {:>20.2f} {:>8} {:>24}\n", strategy, s.rows, s.largest_bias, s.defects,
               s.relative_costs.empty() ? "" : fmt::format("{:.2f}", median(s.relative_costs)));
  }
  const auto rejection = summaries.find("rejection");
  const std::size_t done = rejection == summaries.end() ? 0 : rejection->second.rows;
  if (std::ranges::count(strategies, "rejection") > 0 && done < cases)
    fmt::print("rejection is left out of {} cases: more than {:.0f} proposals a sample\n", cases - done,
               most_proposals);
}

} // namespace

const char* const sampling_columns =
    "strategy,kd,ks,n,theta_deg,samples,mean,exact,bias_sigma,variance,variance_standard_error,"
    "rays_per_sample,ns_per_sample,variance_times_cost,variance_times_rays,draws_per_sample,roulette,defects,"
    "ns_least,ns_most,seed,device,width";

std::vector<Case> sampling_cases(bool quick) {
  std::vector<Case> cases = {{.4, .05, 50, 30}, {.4, .05, 50, 85}, {.4, .4, 10, 60}, {.1, .8, 90, 30}};
  const auto add_grid = [&](const std::vector<std::pair<double, double>>& materials,
                            const std::vector<double>& exponents, const std::vector<double>& angles) {
    for (const auto& [diffuse, specular] : materials)
      for (const double exponent : exponents)
        for (const double angle : angles) cases.push_back({diffuse, specular, exponent, angle});
  };
  if (quick)
    add_grid({{.4, .4}}, {1, 1000}, {30, 60, 85});
  else
    add_grid({{.4, .05}, {.4, .4}, {.1, .8}, {0, .9}}, {0, 1, 10, 100, 1e3, 1e4, 1e6},
             {0, 30, 60, 75, 85, 89.9});
  return cases;
}

void measure_sampling(const SamplingOptions& options) {
  CsvFile table(options.folder, "sampling.csv", sampling_columns);
  const device::Device device = device::open_devices(options.devices).front();
  const int lanes = options.lanes != 0 ? options.lanes : device.info.lanes;
  const auto strategies = options.strategies.empty() ? render::strategy_names() : options.strategies;
  const auto cases = options.cases.empty() ? sampling_cases(options.quick) : options.cases;
  std::vector<Sampler> samplers;
  for (const std::string& strategy : strategies) {
    samplers.emplace_back(device, kernel_files(options.kernel_dir), strategy, lanes);
    (void)samplers.back().run({.4, .4, 10, 60}, 1, {{0, 0}}); // warms up
  }
  std::map<std::string, Summary> summaries;
  {
    Progress progress(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      progress.show(i);
      const std::vector<Row> rows = measure(samplers, cases[i], options, static_cast<std::uint32_t>(i));
      for (const Row& row : rows) table.line(line_of(row, device, lanes, options.seed));
      add(summaries, rows);
    }
  }
  fmt::print("{}, WIDTH {}\n", device.info.name, lanes);
  print(strategies, summaries, cases.size());
  fmt::print("{}\n", table.path().string());
}

} // namespace phlux::bench
