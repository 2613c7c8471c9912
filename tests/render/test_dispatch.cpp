// The sharing of launches among processors of different speed, some of which fail.
#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <random>
#include <thread>

#include "render/dispatch.h"

using namespace phlux;
using namespace phlux::render;

namespace {

constexpr int width = 5, height = 3;

// Returns sums that depend on job and sample alone, after a random time. Their exponents differ so much that
// every order of adding them has another sum.
class Fake final : public Processor {
public:
  Fake(unsigned seed, int slowness, double failures)
      : random_(seed), slowness_(slowness), failures_(failures) {}

  void begin(const Settings&) override {}
  [[nodiscard]] Pace pace() const override {
    constexpr double jobs = 4.0;
    return {.lanes = 1, .most_jobs = 1000, .paths = jobs * samples_per_block};
  }
  void enqueue(const Launch& launch) override { results_.emplace_back().launch = launch; }
  [[nodiscard]] std::size_t in_flight() const override { return results_.size(); }
  [[nodiscard]] std::size_t most_in_flight() const override { return 2; }
  void settle() override {
    std::this_thread::sleep_for(
        std::chrono::microseconds(random_() % 100 * static_cast<unsigned>(slowness_)));
    if (std::uniform_real_distribution<>()(random_) < failures_) throw DeviceError("a failure");
    LaunchResult& result = results_.front();
    for (std::int64_t job = result.launch.first_job; job < result.launch.first_job + result.launch.jobs;
         ++job) {
      const std::int64_t pixels = width * height, sample = result.launch.first_sample;
      std::mt19937 of_block(static_cast<unsigned>(
          job % pixels + pixels * (sample + job / pixels * result.launch.block_samples)));
      film::BlockSum sum{};
      for (float& value : sum.radiance)
        value = std::ldexp(1.0F + static_cast<float>(of_block()), static_cast<int>(of_block() % 60) - 60);
      result.sums.push_back(sum);
    }
  }
  [[nodiscard]] LaunchResult& result() override { return results_.front(); }
  void release() noexcept override { results_.pop_front(); }
  [[nodiscard]] LaunchResult detach() override {
    LaunchResult result = std::move(results_.front());
    release();
    return result;
  }
  void abandon() noexcept override { results_.clear(); }
  [[nodiscard]] bool shrink() override { return false; }
  [[nodiscard]] std::string name() const override { return "fake"; }

private:
  std::mt19937 random_;
  int slowness_;
  double failures_;
  std::deque<LaunchResult> results_;
};

struct Rendered {
  film::Film film{width, height};
  RenderState state;
  std::string failure;
};

// By processors of these probabilities of failure, until `launches` are on the film. Returns a checkpoint
// from then, when others are in flight.
Rendered render_by(const std::vector<double>& failures, Rendered& rendered, int launches = 1 << 20) {
  Settings settings;
  settings.samples_per_pixel = 40 * samples_per_block;
  settings.pause_seconds = 0.0;
  std::vector<std::unique_ptr<Fake>> fakes;
  std::vector<Processor*> processors;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    const int slowness = i % 2 == 0 ? 1 : 7;
    fakes.push_back(std::make_unique<Fake>(static_cast<unsigned>(i), slowness, failures[i]));
    processors.push_back(fakes.back().get());
  }
  Events events;
  std::optional<Rendered> checkpoint;
  events.progress = [&](const Progress& progress) {
    if (--launches > 0) return true;
    if (!checkpoint) checkpoint = Rendered{rendered.film, progress.state(), {}};
    return false;
  };
  DispatchLoop loop(settings, rendered.film, events, rendered.state);
  loop.run(processors);
  rendered.state = loop.state();
  rendered.failure = loop.failure();
  return checkpoint.value_or(Rendered());
}

bool same(const film::Film& a, const film::Film& b) {
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    if (a.pixels()[i].sum != b.pixels()[i].sum || a.pixels()[i].samples != b.pixels()[i].samples)
      return false;
  return true;
}

} // namespace

TEST_CASE("the film is the same, to the last bit of its sums, with any number of processors") {
  Rendered one;
  render_by({0.0}, one);
  REQUIRE(one.state.paths == 40 * samples_per_block * width * height);
  for (const std::vector<double>& failures :
       {std::vector{0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.3, 0.3, 1.0}, {0.0, 1.0}}) {
    Rendered several;
    render_by(failures, several);
    CHECK(several.failure.empty());
    CHECK(several.state.paths == one.state.paths);
    CHECK(several.state.position.missing.empty());
    CHECK(same(several.film, one.film));
  }
}

TEST_CASE("a render by several processors that was ended goes on to the same film with another number") {
  Rendered one;
  render_by({0.0}, one);
  for (const int launches : {1, 10, 50}) {
    Rendered parts;
    Rendered checkpoint = render_by({0.0, 0.0, 1.0}, parts, launches);
    for (Rendered* const from : {&parts, &checkpoint}) {
      CHECK(from->state.paths < one.state.paths);
      render_by({0.0}, *from, 5);
      render_by({0.0, 0.0, 0.0, 0.0}, *from);
      CHECK(from->state.paths == one.state.paths);
      CHECK(same(from->film, one.film));
    }
  }
}

TEST_CASE("with no processor left, what is on the film is that of the first launches") {
  Rendered parts;
  render_by({0.5, 1.0}, parts);
  CHECK_FALSE(parts.failure.empty());
  Rendered one;
  render_by({0.0}, one);
  render_by({0.0, 0.0}, parts);
  CHECK(same(parts.film, one.film));
}
