#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <vector>

#include <Random123/philox.h>
#include <boost/random/sobol.hpp>

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

Program with_sampler(const Variant& v, const char* sampler) {
  return Program(v, read_file("random.cl"), std::map<std::string, std::string>{{"SAMPLER", sampler}});
}

std::vector<std::uint32_t> numbers_from(std::uint32_t first, std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

// The words of `count` samples from 1000 on, in sets of 2^bits.
std::vector<Words> set_words(const Program& program, std::size_t count, std::uint32_t bits,
                             std::uint32_t pixel, std::uint32_t dimension, std::uint32_t seed) {
  constexpr std::uint32_t first = 1000;
  std::vector<Words> words(count);
  program.run("set_words", count, numbers_from(first, count), pixel, dimension, on_device({seed, 0}), first,
              bits, out(words));
  return words;
}

// Whether the points are a (0, m, 2)-net in two dimensions, m = log2(count): each elementary interval of
// area 1 / count has one.
bool is_net(const Words* points, std::size_t count, std::size_t x, std::size_t y) {
  const int bits = static_cast<int>(std::bit_width(count)) - 1;
  for (int x_bits = 0; x_bits <= bits; ++x_bits) {
    std::set<std::uint64_t> intervals;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t row = std::uint64_t{points[i][x]} >> (32 - x_bits);
      const std::uint64_t column = std::uint64_t{points[i][y]} >> (32 - (bits - x_bits));
      intervals.insert(row << 32 | column);
    }
    if (intervals.size() != count) return false;
  }
  return true;
}

// Whether each of `count` equal intervals has one of the points.
bool is_stratified(const Words* points, std::size_t count, std::size_t dimension) {
  std::set<std::uint64_t> intervals;
  for (std::size_t i = 0; i < count; ++i) intervals.insert(std::uint64_t{points[i][dimension]} * count >> 32);
  return intervals.size() == count;
}

} // namespace

TEST_CASE("random: points that are not scrambled are those of Boost.Random's Sobol sequence") {
  constexpr std::size_t count = 63; // the sequence leaves out the origin
  boost::random::sobol sequence(4);
  std::set<Words> expected, points;
  for (std::size_t i = 0; i < count; ++i) {
    Words point;
    for (std::uint32_t& word : point) word = static_cast<std::uint32_t>(sequence() >> 32);
    expected.insert(point);
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Words> answers(count);
    program_of("random.cl", v).run("sobol_points", count, numbers_from(1, count), out(answers));
    CHECK(std::set<Words>(answers.begin(), answers.end()) == expected);
  }
}

TEST_CASE("random: sets of Sobol points and their first 2^k points are nets") {
  for (const Variant v : variants) {
    CAPTURE(v);
    const Program program = with_sampler(v, "SAMPLER_SOBOL");
    for (const std::uint32_t bits : {1u, 3u, 6u}) {
      const std::size_t length = std::size_t{1} << bits;
      const std::vector<Words> words = set_words(program, 4 * length, bits, 5, 2, 9);
      for (std::size_t set = 0; set < 4; ++set)
        for (std::size_t part = length; part >= 2; part /= 2) {
          CAPTURE(bits, set, part);
          CHECK(is_net(&words[set * length], part, 0, 1));
          for (std::size_t dimension = 2; dimension < 4; ++dimension)
            CHECK(is_stratified(&words[set * length], part, dimension));
        }
    }
  }
}

// In each of n intervals one point, which is uniform and independent of the others: the mean of a word has
// the variance 1 / (12 n^3). Over 5,000 sets the estimate has a relative standard error of 2%; four words
// within 4.5 standard errors: false alarm 3e-5.
TEST_CASE("random: points of Sobol sets are independent within the intervals of their digits") {
  constexpr std::uint32_t sets = 5000, bits = 6;
  const std::vector<Words> words =
      set_words(with_sampler({16}, "SAMPLER_SOBOL"), sets << bits, bits, 5, 2, 9);
  const double n = std::exp2(bits), expected = 1.0 / (12.0 * n * n * n);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    double variance = 0.0;
    for (std::uint32_t set = 0; set < sets; ++set) {
      double mean = 0.0;
      for (std::uint32_t i = 0; i < n; ++i)
        mean += words[(std::size_t{set} << bits) + i][dimension] / 4294967296.0 / n;
      variance += (mean - 0.5) * (mean - 0.5) / sets;
    }
    CHECK(variance == Approx(expected).epsilon(4.5 * 0.02));
  }
}

TEST_CASE("random: sets of lattice points are stratified in each dimension") {
  for (const Variant v : variants) {
    CAPTURE(v);
    const Program program = with_sampler(v, "SAMPLER_LATTICE");
    for (const std::uint32_t bits : {1u, 3u, 6u})
      for (std::size_t dimension = 0; dimension < 4; ++dimension)
        CHECK(is_stratified(set_words(program, 1u << bits, bits, 5, 2, 9).data(), 1u << bits, dimension));
  }
}

TEST_CASE("random: sets differ by pixel, dimension, seed and number; sets of one sample are independent") {
  for (const char* sampler : {"SAMPLER_SOBOL", "SAMPLER_LATTICE"}) {
    CAPTURE(sampler);
    const Program program = with_sampler({16}, sampler);
    const std::vector<Words> words = set_words(program, 16, 3, 5, 2, 9);
    CHECK(set_words(program, 16, 3, 5, 2, 9) == words);
    CHECK(words[0] != words[8]);
    CHECK(set_words(program, 16, 3, 6, 2, 9)[0] != words[0]);
    CHECK(set_words(program, 16, 3, 5, 3, 9)[0] != words[0]);
    CHECK(set_words(program, 16, 3, 5, 2, 8)[0] != words[0]);
    const std::vector<Words> single = set_words(program, 16, 0, 5, 2, 9);
    for (std::uint32_t i = 0; i < 16; ++i) CHECK(single[i] == random123(7, {5, 1000 + i, 2, 0}, {9, 0}));
  }
}

// Over 20,000 sets: means of the first and the last point, the mean product of two words of a point, and that
// of words of a point in two padded dimensions. 4 x 4 values and two samplers within 4.5 standard errors:
// false alarm 2e-4.
TEST_CASE("random: each point of a set is uniform, and its words are independent") {
  constexpr std::uint32_t sets = 20'000, bits = 4;
  constexpr double limit = 4.5;
  for (const char* sampler : {"SAMPLER_SOBOL", "SAMPLER_LATTICE"}) {
    const Program program = with_sampler({16}, sampler);
    const std::vector<Words> one = set_words(program, sets << bits, bits, 5, 2, 9);
    const std::vector<Words> other = set_words(program, sets << bits, bits, 5, 3, 9);
    const auto real = [](std::uint32_t word) { return word / 4294967296.0 - 0.5; };
    const double n = sets, of_mean = std::sqrt(1.0 / 12.0 / n), of_product = 1.0 / 12.0 / std::sqrt(n);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      double first = 0.0, last = 0.0, product = 0.0, padded = 0.0;
      for (std::uint32_t set = 0; set < sets; ++set) {
        const std::size_t begin = std::size_t{set} << bits, end = begin + (1u << bits) - 1;
        first += real(one[begin][dimension]) / n;
        last += real(one[end][dimension]) / n;
        product += real(one[end][dimension]) * real(one[end][(dimension + 1) % 4]) / n;
        padded += real(one[end][dimension]) * real(other[end][dimension]) / n;
      }
      CAPTURE(sampler, dimension);
      CHECK(std::abs(first) < limit * of_mean);
      CHECK(std::abs(last) < limit * of_mean);
      CHECK(std::abs(product) < limit * of_product);
      CHECK(std::abs(padded) < limit * of_product);
    }
  }
}

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
