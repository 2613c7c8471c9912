// A render that resumes from a checkpoint equals an uninterrupted one.
#include <cmath>

#include <catch2/catch.hpp>

#include "checkpoint/session.h"
#include "temporary_folder.h"

using namespace phlux;

namespace {

Broken begun(const std::string& integrator, int samples, double launch_seconds = 0.001) {
  Broken broken;
  broken.session.settings.integrator = integrator;
  broken.session.settings.samples_per_pixel = samples;
  broken.session.settings.seed = 5;
  broken.session.settings.launch_seconds = launch_seconds;
  return broken;
}

// The bytes of the whole state.
std::string bytes_of(Broken broken) {
  broken.session.state.seconds_render = 0.0;
  return checkpoint::encode(broken.session, broken.film);
}

void through_a_file(Broken& broken) {
  const TemporaryFolder folder;
  folder.write("c", checkpoint::encode(broken.session, broken.film));
  checkpoint::Checkpoint read = checkpoint::read(folder / "c");
  read.session.settings.launch_seconds = broken.session.settings.launch_seconds;
  broken = {std::move(read.session), std::move(read.film)};
}

// Largest difference of two images, relative to their mean.
double difference(const film::Film& a, const film::Film& b) {
  double largest = 0.0, sum = 0.0;
  for (std::size_t pixel = 0; pixel < a.pixels().size(); ++pixel)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      largest = std::max(largest, std::abs(a.mean(pixel)[channel] - b.mean(pixel)[channel]));
      sum += a.mean(pixel)[channel];
    }
  return largest / (sum / (3.0 * static_cast<double>(a.pixels().size())));
}

constexpr double rounding = 1e-5; // of float32 sums in a pixel much brighter than the mean

} // namespace

TEST_CASE("A render that was interrupted twice has the film and counts of an uninterrupted one") {
  const std::string integrator = GENERATE("path", "light", "bidir");
  CAPTURE(integrator);
  Broken whole = begun(integrator, 180, 0.05);
  go_on(whole);
  REQUIRE(whole.session.state.position.end() == 180);

  Broken broken = begun(integrator, 180);
  go_on(broken, 2);
  CHECK_FALSE(broken.session.state.position.missing.empty()); // a launch that was running
  through_a_file(broken);
  const std::uint64_t paths = broken.session.state.paths;
  go_on(broken, 3);
  CHECK(broken.session.state.paths > paths);
  CHECK(broken.session.state.paths < whole.session.state.paths);
  through_a_file(broken);
  go_on(broken);
  CHECK((bytes_of(broken) == bytes_of(whole))); // too long to print
}

TEST_CASE("A render continues to more samples, also after one with a time limit") {
  const bool open_ended = GENERATE(false, true);
  Broken whole = begun("path", 100);
  go_on(whole);
  Broken broken = begun("path", 10);
  if (open_ended) broken.session.settings.time_limit = 1000.0;
  go_on(broken, open_ended ? 5 : -1);
  broken.session.settings.time_limit.reset();
  broken.session.settings.samples_per_pixel = 100;
  go_on(broken);
  CHECK(broken.session.state.paths == whole.session.state.paths);
  CHECK(broken.session.state.rays == whole.session.state.rays); // the same samples
  CHECK(difference(broken.film, whole.film) < rounding);
}

TEST_CASE("Samples from number N on are those that follow the first N") {
  Broken whole = begun("path", 40), first = begun("path", 20), second = begun("path", 20);
  second.session.settings.first_sample = 20;
  for (Broken* broken : {&whole, &first, &second}) go_on(*broken);
  CHECK(first.session.state.rays + second.session.state.rays == whole.session.state.rays);
  CHECK(first.session.state.rays != second.session.state.rays);
}
