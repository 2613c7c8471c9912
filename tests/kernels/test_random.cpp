#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include <Random123/philox.h>

#include "device_test.h"
#include "directions.h"

using namespace device_test;

namespace {

using Words = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

struct KnownAnswer {
  int rounds = 0;
  Words counter{};
  Key key{};
  Words answer{};
};

std::vector<KnownAnswer> known_answers() {
  std::vector<KnownAnswer> answers;
  std::istringstream lines(read_file("philox_known_answers.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    KnownAnswer known;
    words >> known.rounds >> std::hex;
    for (auto& word : known.counter) words >> word;
    for (auto& word : known.key) words >> word;
    for (auto& word : known.answer) words >> word;
    REQUIRE(words);
    answers.push_back(known);
  }
  REQUIRE(answers.size() == 6);
  return answers;
}

Words random123(int rounds, const Words& counter, const Key& key) {
  const philox4x32_ctr_t c = {{counter[0], counter[1], counter[2], counter[3]}};
  const philox4x32_key_t k = {{key[0], key[1]}};
  const auto words = philox4x32_R(static_cast<unsigned>(rounds), c, k);
  return {words[0], words[1], words[2], words[3]};
}

cl_uint2 on_device(const Key& key) {
  return {{key[0], key[1]}};
}

std::vector<Words> random_counters(std::size_t count, Random& random) {
  std::vector<Words> counters(count);
  for (auto& counter : counters)
    for (auto& word : counter) word = random.word();
  return counters;
}

} // namespace

TEST_CASE("random: Random123 on the host gives the known answers") {
  for (const KnownAnswer& known : known_answers())
    CHECK(random123(known.rounds, known.counter, known.key) == known.answer);
}

TEST_CASE("random: Philox on the device gives the known answers, of 7 rounds and of 10") {
  for (const Variant v : variants)
    for (const int rounds : {7, 10}) {
      CAPTURE(v, rounds);
      const Program program(v, read_file("random.cl"), {{"PHILOX_ROUNDS", std::to_string(rounds)}});
      for (const KnownAnswer& known : known_answers())
        if (known.rounds == rounds) {
          std::vector<Words> answer(static_cast<std::size_t>(v.width));
          program.run("words", answer.size(), std::vector<Words>{known.counter}, on_device(known.key),
                      out(answer));
          for (const Words& lane : answer) CHECK(lane == known.answer);
        }
    }
}

TEST_CASE("random: Philox on the device is Random123's with the same number of rounds") {
  Random random(11);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto program = program_of("random.cl", v);
    std::vector<int> rounds(1);
    program.run("rounds", 1, table(rounds));
    CHECK(rounds[0] == 7);
    for (int round = 0; round < 4; ++round) {
      const auto counters = random_counters(thinned(5000), random);
      const Key key = {random.word(), random.word()};
      std::vector<Words> answers(counters.size());
      program.run("words", counters.size(), counters, on_device(key), out(answers));
      for (std::size_t i = 0; i < counters.size(); ++i)
        REQUIRE(answers[i] == random123(rounds[0], counters[i], key));
    }
  }
}

TEST_CASE("random: the counter is pixel, sample, dimension, draw; the key is the seed") {
  Random random(12);
  for (const Variant v : variants) {
    CAPTURE(v);
    auto places = random_counters(100, random);
    const Key seed = {random.word(), random.word()};
    const std::uint32_t draw = random.word();
    std::vector<Words> answers(places.size());
    program_of("random.cl", v)
        .run("sequence_words", places.size(), places, on_device(seed), draw, out(answers));
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i][3] = draw;
      REQUIRE(answers[i] == random123(7, places[i], seed));
    }
  }
}

TEST_CASE("random: uniform_real stays in the open interval and is exact") {
  Random random(13);
  std::vector<std::uint32_t> words{0,          1,          0x1ff,      0x200,     0x7fffffff,
                                   0x80000000, 0xfffffdff, 0xfffffe00, 0xffffffff};
  while (words.size() < 10000) words.push_back(random.word());
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<float> uniform(words.size());
    program_of("random.cl", v).run("uniforms", words.size(), words, out(uniform));
    for (std::size_t i = 0; i < words.size(); ++i) {
      REQUIRE(uniform[i] > 0.0f);
      REQUIRE(uniform[i] < 1.0f);
      REQUIRE(static_cast<double>(uniform[i]) == (2.0 * (words[i] >> 9) + 1) * std::exp2(-24));
    }
    CHECK(uniform[0] == std::exp2(-24.0f));
    CHECK(uniform[8] == 1.0f - std::exp2(-24.0f));
  }
}
