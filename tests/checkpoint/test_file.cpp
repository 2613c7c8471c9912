// The checkpoint file, and the errors of damaged ones.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "checkpoint/checkpoint.h"
#include "checkpoint/first_line.h"
#include "checkpoint/sameness.h"
#include "errors.h"
#include "film/reliability.h"
#include "temporary_folder.h"

using namespace phlux;
using Catch::Contains;

namespace {

film::Film small_film() {
  film::Film film(3, 2);
  film.set_unit(4.0);
  film.use_splats();
  film.add(1, {{1, 2, 3}, {1, 4, 9}}, 1);
  film.add_splatting_paths(6);
  film.add_splat(4, {0.5, 0.25, 0.125});
  film.use_techniques();
  film.techniques()->add({2, 1}, 4, {0.5, 0.25, 0.125}, 0.75);
  return film;
}

checkpoint::Session small_session() {
  checkpoint::Session session{
      .scene = "box.xml", .scene_digest = "1234", .choices = {}, .settings = {}, .state = {}};
  session.choices.definitions["a"] = "b";
  session.choices.choose(settings::named("seed"), "7");
  session.settings.seed = 7;
  session.state.paths = 96;
  session.state.first_nonfinite = {3, 1, 2};
  session.state.position = {16, 2, 16, {{0, 2, 0, 16}}};
  session.state.seconds_render = 2.5;
  return session;
}

// A film of that session: all pixels have 16 samples, as the first two lack those that are missing.
film::Film film_of_session() {
  film::Film film(3, 2);
  for (std::size_t pixel = 0; pixel < 6; ++pixel) film.add(pixel, {{1, 2, 3}, {1, 4, 9}}, 16);
  return film;
}

struct Saved : TemporaryFolder {
  std::string bytes = checkpoint::encode(small_session(), small_film());

  // The error for a file with these bytes.
  [[nodiscard]] std::string refusal(const std::string& text) const {
    write("c", text);
    try {
      static_cast<void>(checkpoint::read(*this / "c"));
    } catch (const FileError& error) {
      return error.what();
    }
    return "nothing";
  }
};

} // namespace

TEST_CASE("A checkpoint read from its file is complete") {
  const Saved saved;
  saved.write("c", saved.bytes);
  const checkpoint::Checkpoint read = checkpoint::read(saved / "c");
  CHECK(checkpoint::encode(read.session, read.film) == saved.bytes);
  CHECK(read.film.width() == 3);
  CHECK(read.film.height() == 2);
  CHECK(read.film.mean(1) == small_film().mean(1));
  CHECK(read.film.mean(4) == small_film().mean(4));
  CHECK(read.film.has_variance() == small_film().has_variance());
  CHECK(read.session.choices.texts == small_session().choices.texts);
  CHECK(read.session.choices.definitions == small_session().choices.definitions);
  CHECK(read.session.state.position.missing.size() == 1);
  CHECK(read.session.state.first_nonfinite->pixel == 3);
}

TEST_CASE("The format is that of its version: who changes one raises the other, and then this length") {
  CHECK(Saved().bytes.substr(0, 19) == "phlux checkpoint 5 ");
  CHECK(Saved().bytes.size() == 10030);
}

TEST_CASE("A file that is not a complete checkpoint of this version is refused with the reason") {
  const Saved saved;
  CHECK(saved.refusal(saved.bytes) == "nothing");
  CHECK_THAT(saved.refusal(""), Contains("is not a checkpoint of phlux"));
  CHECK_THAT(saved.refusal("<scene version=\"0.6.0\"/>\n"), Contains("is not a checkpoint of phlux"));
  for (const std::size_t length :
       {std::size_t{20}, std::size_t{60}, std::size_t{74}, saved.bytes.size() / 2, saved.bytes.size() - 1})
    CHECK_THAT(saved.refusal(saved.bytes.substr(0, length)), Contains("is incomplete"));
  CHECK_THAT(saved.refusal(saved.bytes + "x"), Contains("is incomplete"));
  for (const std::size_t place :
       {std::size_t{25}, std::size_t{80}, saved.bytes.size() / 2, saved.bytes.size() - 1}) {
    std::string damaged = saved.bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    CHECK_THAT(saved.refusal(damaged), Contains("is damaged"));
  }
  std::string later = saved.bytes;
  later[17] = '9';
  CHECK_THAT(saved.refusal(later), Contains("is a checkpoint of format 9") && Contains("reads format 5"));
  CHECK_THROWS_WITH(checkpoint::read(saved / "missing"), Contains("missing: cannot be read: No such file"));
  CHECK_THROWS_WITH(checkpoint::read(saved.path()), Contains("is not a file"));
}

TEST_CASE("A file with a bit flipped, or cut off, is refused") {
  const Saved saved;
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const std::size_t place = random() % saved.bytes.size();
    const unsigned bit = random() % 16; // eight of them cut the file off
    std::string damaged = saved.bytes;
    if (bit < 8)
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << bit));
    else
      damaged.resize(place);
    CAPTURE(i, place, bit);
    CHECK(saved.refusal(damaged) != "nothing");
  }
}

namespace {

std::string refusal(const checkpoint::Session& now, int width = 3) {
  try {
    checkpoint::check_same({small_session(), film_of_session()}, now, width, 2, "c");
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

std::string refusal(const std::function<void(render::Settings&)>& change) {
  checkpoint::Session now = small_session();
  change(now.settings);
  return refusal(now);
}

} // namespace

TEST_CASE("A checkpoint of another image is refused, naming what differs") {
  using render::Settings;
  checkpoint::Session now = small_session();
  now.settings.samples_per_pixel = 32;
  CHECK(refusal(now) == "nothing");
  CHECK(refusal(now, 5) == "c: is of 3x2 pixels, not 5x2: give `size` 3x2");
  now.scene_digest = "4321";
  CHECK_THAT(refusal(now), Contains("c: is of another scene: give box.xml as it was"));

  CHECK_THAT(
      refusal([](Settings& s) { s.integrator = "bidir"; }),
      Contains(
          "c: is of a render with `integrator` path, not with `integrator` bidir: give `integrator` path"));
  CHECK_THAT(refusal([](Settings& s) { s.strategy = "cosine"; }), Contains("`strategy`"));
  CHECK_THAT(refusal([](Settings& s) { s.connect = render::Connect::none; }), Contains("`connect` mis"));
  CHECK_THAT(refusal([](Settings& s) { s.weights = render::Weights::power; }), Contains("`weights` balance"));
  CHECK_THAT(refusal([](Settings& s) { s.light_selection = render::LightSelection::power; }),
             Contains("`light-selection`"));
  CHECK_THAT(refusal([](Settings& s) { s.connections = 0; }), Contains("`connections` 2"));
  CHECK_THAT(refusal([](Settings& s) { s.techniques = true; }), Contains("leave out `contributions`"));
  CHECK_THAT(refusal([](Settings& s) { s.ambient = 0.5; }), Contains("leave out `ambient`"));
  CHECK_THAT(refusal([](Settings& s) { s.clamp = 5.0; }), Contains("without `clamp`, not with `clamp` 5"));
  CHECK_THAT(refusal([](Settings& s) { s.max_depth = 3; }), Contains("`max-depth` -1"));
  CHECK_THAT(refusal([](Settings& s) { s.rr_depth = 3; }), Contains("`rr-depth` 5"));
  CHECK_THAT(refusal([](Settings& s) { s.roulette = render::Roulette::kd_ks; }),
             Contains("`roulette` efficiency"));
  CHECK_THAT(refusal([](Settings& s) { s.seed = 8; }), Contains("`seed` 7"));
  CHECK_THAT(refusal([](Settings& s) { s.first_sample = 8; }), Contains("`first-sample` 0"));
  CHECK_THAT(refusal([](Settings& s) { s.double_precision = true; }), Contains("`precision` single"));
}

TEST_CASE("A checkpoint with more samples than requested is refused") {
  CHECK_THAT(
      refusal([](render::Settings& s) { s.samples_per_pixel = 31; }),
      Contains("has 32 samples per pixel already, and `spp` 31 asks for fewer: give `spp` 32 or more"));
  CHECK(refusal([](render::Settings& s) { s.time_limit = 1.0; }) == "nothing");
}

namespace {

// What a render that resumes from this state says.
std::string refusal_of(const std::function<void(checkpoint::Checkpoint&)>& forge) {
  checkpoint::Checkpoint earlier{small_session(), film_of_session()};
  forge(earlier);
  checkpoint::Session now = small_session();
  now.settings.samples_per_pixel = 32;
  try {
    checkpoint::check_same(earlier, now, 3, 2, "c");
  } catch (const FileError& error) {
    return error.what();
  }
  return "nothing";
}

} // namespace

TEST_CASE("A forged state is refused, whatever number is wrong") {
  using checkpoint::Checkpoint;
  CHECK(refusal_of([](Checkpoint&) {}) == "nothing");
  const auto refuses = [](const char* what, const std::function<void(Checkpoint&)>& forge) {
    CHECK_THAT(refusal_of(forge), Contains("c: is damaged: ") && Contains(what));
  };
  constexpr auto huge = std::int64_t{1} << 62;
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{6}, huge})
    refuses("its position", [&](Checkpoint& c) { c.session.state.position.pixel = wrong; });
  // With the two pixels' block of 16 beyond it, the last is one sample more than there can be.
  for (const std::int64_t wrong : {std::int64_t{-1}, huge, settings::most_samples - 15})
    refuses("its position", [&](Checkpoint& c) { c.session.state.position.sample = wrong; });
  for (const int wrong : {0, -1, 65, 1 << 30})
    refuses("its position", [&](Checkpoint& c) { c.session.state.position.block_samples = wrong; });
  for (const render::Launch wrong : {render::Launch{-1, 2, 0, 16},
                                     {6, 2, 0, 16},
                                     {0, 0, 0, 16},
                                     {0, huge, 0, 16},
                                     {0, 2, -1, 16},
                                     {0, 2, huge, 16},
                                     {0, 2, 0, 0},
                                     {0, 2, 0, 1 << 30},
                                     {0, 13, 0, 16}})
    refuses("its missing samples", [&](Checkpoint& c) { c.session.state.position.missing = {wrong}; });
  refuses("numbers of samples", [](Checkpoint& c) { c.session.state.position.missing = {}; });
  refuses("numbers of samples", [](Checkpoint& c) { c.session.state.position.missing = {{1, 2, 0, 16}}; });
  refuses("numbers of samples", [](Checkpoint& c) { c.film.pixels()[3].samples = 17; });
  refuses("sums of samples", [](Checkpoint& c) { c.film.pixels()[3].sum[1] = std::nan(""); });
  refuses("sums of samples", [](Checkpoint& c) { c.film.pixels()[3].sum_of_squares[1] = -1; });
  refuses("sums over the image", [](Checkpoint& c) { c.film.set_unit(0); });
  refuses("numbers of paths", [](Checkpoint& c) { c.session.state.paths = 97; });
  refuses("numbers of paths", [](Checkpoint& c) { c.film.add_splatting_paths(6); });
  refuses("its seconds", [](Checkpoint& c) { c.session.state.seconds_render = std::nan(""); });
  refuses("its first contribution", [](Checkpoint& c) { c.session.state.first_nonfinite = {6, 1, 2}; });
  refuses("clamping", [](Checkpoint& c) { c.film.set_clamp(1); });
  refuses("splats", [](Checkpoint& c) {
    c.film.use_splats();
    c.film.add_splatting_paths(96);
  });
}

TEST_CASE("The first inputs of the fuzzer are checkpoints of this version") {
  const Saved place;
  for (const char* integrator : {"path", "light", "bidir"}) {
    const std::string bytes =
        TemporaryFolder::read(std::string(PHLUX_SOURCE_DIR "/tests/fuzz/corpus/checkpoint/") + integrator);
    place.write("input", test::with_first_line(bytes));
    CHECK(checkpoint::read(place / "input").session.settings.integrator == integrator);
  }
}

TEST_CASE("A file with any byte changed and the right digest is refused, or has a state of the render") {
  const Saved place;
  const std::string bytes = checkpoint::encode(small_session(), film_of_session());
  checkpoint::Session now = small_session();
  now.settings.samples_per_pixel = 32;
  const std::size_t begin = bytes.find('\n') + 1;
  std::size_t accepted = 0;
  constexpr std::size_t numbers = 2000; // of the session and the pixels; a histogram of sizes follows
  for (std::size_t place_of = begin; place_of < bytes.size(); place_of += place_of < numbers ? 1 : 7) {
    std::string forged = bytes;
    forged[place_of] = static_cast<char>(forged[place_of] ^ (place_of % 3 == 0   ? 0x80
                                                             : place_of % 3 == 1 ? 0xff
                                                                                 : 1));
    place.write("forged", test::with_first_line(forged.substr(begin)));
    try {
      checkpoint::Checkpoint earlier = checkpoint::read(place / "forged");
      checkpoint::check_same(earlier, now, 3, 2, "forged");
      for (std::size_t pixel = 0; pixel < 6; ++pixel) earlier.film.add(pixel, {{1, 2, 3}, {1, 4, 9}}, 16);
      static_cast<void>(film::reliability_of(earlier.film));
      ++accepted;
    } catch (const Error&) { // anything else fails the test
    }
  }
  CHECK(accepted > 0); // sums that are other numbers
}
