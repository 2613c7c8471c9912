#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "device_test.h"
#include "directions.h"

using namespace device_test;

namespace {

constexpr std::size_t items = 257; // of lanes

std::size_t lanes_of(Variant v) {
  return items * static_cast<std::size_t>(v.width);
}

// 0 or 1 in each lane: items with no lanes set, with all, with one, and with random ones.
std::vector<int> random_masks(Variant v, Random& random) {
  std::vector<int> mask(lanes_of(v));
  const auto width = static_cast<std::size_t>(v.width);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const std::size_t item = i / width, lane = i % width;
    if (item < width)
      mask[i] = lane == item;
    else
      mask[i] = item % 8 == 0 ? 0 : item % 8 == 1 ? 1 : static_cast<int>(random.word() & 1);
  }
  return mask;
}

std::vector<float> random_reals(std::size_t count, Random& random) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random.uniform(-100, 100));
  return values;
}

} // namespace

TEST_CASE("lanes: gather reads one word in each lane") {
  struct Row {
    int a;
    float b;
    int c;
  };
  Random random(1);
  std::vector<float> reals(1000);
  std::vector<int> ints(1000);
  std::vector<Row> rows(1000);
  for (int i = 0; i < 1000; ++i) {
    const auto at = static_cast<std::size_t>(i);
    reals[at] = static_cast<float>(i) * 0.5f;
    ints[at] = i * 3;
    rows[at] = {-1, static_cast<float>(i) + 0.25f, i * 7};
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<int> index(lanes_of(v)), whole(index.size()), c(index.size());
    std::vector<float> real(index.size()), b(index.size());
    for (int& i : index) i = static_cast<int>(random.word() % 1000);
    program_of("lanes.cl", v)
        .run("gather", index.size(), table(reals), table(ints), table(rows), index, out(real), out(whole),
             out(b), out(c));
    for (std::size_t i = 0; i < index.size(); ++i) {
      const auto at = static_cast<std::size_t>(index[i]);
      REQUIRE(real[i] == reals[at]);
      REQUIRE(whole[i] == ints[at]);
      REQUIRE(b[i] == rows[at].b);
      REQUIRE(c[i] == rows[at].c);
    }
  }
}

// Otherwise the tests at WIDTH 16 would test the portable lanes twice. Other compilers may refuse the
// builtins.
TEST_CASE("lanes: where warnings are errors, the compiler takes the processor's own instructions") {
  const char* options = std::getenv("PHLUX_KERNEL_OPTIONS");
  if (options == nullptr || std::string(options).find("-Werror") == std::string::npos) return;
  (void)program_of("lanes.cl", {16, false});
  CHECK_FALSE(phlux::device::portable_lanes(test_device()));
}

TEST_CASE("lanes: scatter writes in lane order, and only the lanes of the mask") {
  Random random(2);
  for (const Variant v : variants) {
    CAPTURE(v);
    constexpr int places = 5; // fewer than lanes: the last lane of the mask wins
    const auto width = static_cast<std::size_t>(v.width);
    std::vector<int> index(lanes_of(v));
    for (std::size_t i = 0; i < index.size(); ++i)
      index[i] = static_cast<int>(i / width) * places + static_cast<int>(random.word() % places);
    const auto chosen = random_masks(v, random);
    const auto value = random_reals(index.size(), random);
    std::vector<float> base(items * places, 1e6f), expected = base;
    for (std::size_t i = 0; i < index.size(); ++i)
      if (chosen[i] != 0) expected[static_cast<std::size_t>(index[i])] = value[i];
    program_of("lanes.cl", v).run("scatter", index.size(), table(base), index, value, chosen);
    CHECK(base == expected);
  }
}

TEST_CASE("lanes: append_lanes packs the lanes of the mask in lane order") {
  Random random(3);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto width = static_cast<std::size_t>(v.width);
    const auto first = random_masks(v, random), second = random_masks(v, random);
    const auto key = random_reals(first.size(), random);
    std::vector<int> value(first.size());
    for (int& each : value) each = static_cast<int>(random.word() % 1000);
    std::vector<float> keys(2 * first.size()), expected_keys(keys.size(), 0.0f);
    std::vector<int> values(keys.size()), expected_values(keys.size(), 0), counts(items), expected_counts;
    for (std::size_t item = 0; item < items; ++item) {
      std::size_t at = 2 * width * item;
      for (const auto* mask : {&first, &second})
        for (std::size_t i = item * width; i < (item + 1) * width; ++i)
          if ((*mask)[i] != 0) {
            expected_keys[at] = mask == &first ? key[i] : key[i] + 1000.0f;
            expected_values[at++] = mask == &first ? value[i] : value[i] + 1000;
          }
      expected_counts.push_back(static_cast<int>(at - 2 * width * item));
    }
    program_of("lanes.cl", v)
        .run("append", first.size(), first, second, key, value, table(keys), table(values), table(counts));
    CHECK(counts == expected_counts);
    CHECK(keys == expected_keys);
    CHECK(values == expected_values);
  }
}

TEST_CASE("lanes: questions and reductions across lanes") {
  Random random(4);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto chosen = random_masks(v, random);
    auto real = random_reals(chosen.size(), random);
    real[real.size() / 2] = std::numeric_limits<float>::infinity();
    real[real.size() / 3] = -std::numeric_limits<float>::infinity();
    std::vector<std::uint32_t> whole(chosen.size());
    for (auto& each : whole) each = random.word(); // sums wrap around
    std::vector<int> any(items), all(items), first(items);
    std::vector<float> least(items);
    std::vector<std::uint32_t> sum(items);
    program_of("lanes.cl", v)
        .run("across", chosen.size(), chosen, real, whole, table(any), table(all), table(first), table(least),
             table(sum));
    for (std::size_t item = 0; item < items; ++item) {
      CAPTURE(item);
      const auto begin = static_cast<std::ptrdiff_t>(item) * v.width, end = begin + v.width;
      const auto mask_begin = chosen.begin() + begin, mask_end = chosen.begin() + end;
      const auto one = std::find(mask_begin, mask_end, 1);
      REQUIRE(any[item] == (one != mask_end));
      REQUIRE(all[item] == (std::find(mask_begin, mask_end, 0) == mask_end));
      REQUIRE(first[item] == (one == mask_end ? -1 : one - mask_begin));
      REQUIRE(least[item] == *std::min_element(real.begin() + begin, real.begin() + end));
      std::uint32_t expected = 0;
      for (auto i = begin; i < end; ++i) expected += whole[static_cast<std::size_t>(i)];
      REQUIRE(sum[item] == expected);
    }
  }
}

TEST_CASE("lanes: counting, ranking, packing and unpacking the lanes of a mask") {
  Random random(9);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto width = static_cast<std::size_t>(v.width);
    const auto chosen = random_masks(v, random);
    const auto real = random_reals(chosen.size(), random), old = random_reals(chosen.size(), random);
    std::vector<int> whole(chosen.size()), count(items), rank(whole.size()), packed_int(whole.size());
    for (int& each : whole) each = static_cast<int>(random.word()) >> 8; // exact in float32
    std::vector<float> packed(whole.size()), unpacked(whole.size());
    program_of("lanes.cl", v)
        .run("packs", whole.size(), chosen, real, whole, old, table(count), out(rank), out(packed),
             out(packed_int), out(unpacked));
    for (std::size_t item = 0; item < items; ++item) {
      CAPTURE(item);
      const std::size_t begin = item * width;
      std::size_t before = 0;
      for (std::size_t i = begin; i < begin + width; ++i) {
        const std::size_t at = begin + before;
        if (chosen[i] == 0) {
          REQUIRE(unpacked[i] == old[i]);
          continue;
        }
        REQUIRE(rank[i] == static_cast<int>(before));
        REQUIRE(packed[at] == real[i]);
        REQUIRE(packed_int[at] == whole[i]);
        REQUIRE(unpacked[i] == real[at]);
        ++before;
      }
      REQUIRE(count[item] == static_cast<int>(before));
    }
  }
}

TEST_CASE("lanes: scatter_int and add_vec take one lane after another") {
  Random random(10);
  for (const Variant v : variants) {
    CAPTURE(v);
    constexpr int places = 5; // fewer than lanes, so that lanes share places
    const auto width = static_cast<std::size_t>(v.width);
    const auto chosen = random_masks(v, random);
    const auto real = random_reals(chosen.size(), random);
    std::vector<int> index(chosen.size()), whole(chosen.size());
    for (std::size_t i = 0; i < index.size(); ++i) {
      index[i] = static_cast<int>(i / width) * places + static_cast<int>(random.word() % places);
      whole[i] = static_cast<int>(random.word());
    }
    std::vector<int> ints(items * places, -7), expected_ints = ints;
    std::vector<float> sums(4 * items * places, 0.5f), expected_sums = sums;
    for (std::size_t i = 0; i < index.size(); ++i)
      if (chosen[i] != 0) {
        expected_ints[static_cast<std::size_t>(index[i])] = whole[i];
        const auto at = 4 * static_cast<std::size_t>(index[i]);
        expected_sums[at] += real[i];
        expected_sums[at + 1] += 2 * real[i];
        expected_sums[at + 2] -= real[i];
      }
    program_of("lanes.cl", v)
        .run("scatter_and_add", index.size(), table(ints), table(sums), index, whole, real, chosen);
    CHECK(ints == expected_ints);
    CHECK(sums == expected_sums);
  }
}

TEST_CASE("lanes: a small table can be looked up in registers") {
  struct Row {
    int a;
    float b;
    int c;
  };
  constexpr int entries = 16; // TABLE_ENTRIES
  Random random(12);
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<Row> rows;
    for (int i = 0; i < entries; ++i) rows.push_back({-1, static_cast<float>(i) + 0.25f, i * 7 - 20});
    std::vector<int> index(lanes_of(v)), c(index.size());
    std::vector<float> b(index.size());
    for (int& i : index) i = static_cast<int>(random.word() % entries);
    program_of("lanes.cl", v).run("permutes", index.size(), table(rows), index, out(b), out(c));
    for (std::size_t i = 0; i < index.size(); ++i) {
      REQUIRE(b[i] == rows[static_cast<std::size_t>(index[i])].b);
      REQUIRE(c[i] == rows[static_cast<std::size_t>(index[i])].c);
    }
  }
}

TEST_CASE("lanes: stores write one word for each lane, in lane order") {
  Random random(11);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto real = random_reals(lanes_of(v), random);
    std::vector<int> whole(real.size()), ints(real.size());
    std::vector<float> reals(real.size());
    for (int& each : whole) each = static_cast<int>(random.word());
    program_of("lanes.cl", v).run("stores", real.size(), real, whole, table(reals), table(ints));
    CHECK(reals == real);
    CHECK(ints == whole);
  }
}

TEST_CASE("lanes: to arrays and back, and the lanes' numbers") {
  Random random(5);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto real = random_reals(lanes_of(v), random);
    std::vector<int> whole(real.size()), whole_back(real.size()), number(real.size());
    std::vector<float> real_back(real.size());
    for (int& each : whole) each = static_cast<int>(random.word() % 1000);
    program_of("lanes.cl", v)
        .run("arrays", real.size(), real, whole, out(real_back), out(whole_back), out(number));
    for (std::size_t i = 0; i < real.size(); ++i) {
      REQUIRE(real_back[i] == 2 * real[i]);
      REQUIRE(whole_back[i] == 2 * whole[i]);
      REQUIRE(number[i] == static_cast<int>(i) % v.width);
    }
  }
}

TEST_CASE("lanes: both halves of a 64-bit product") {
  Random random(6);
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<std::uint32_t> a(lanes_of(v)), high(a.size()), low(a.size());
    for (auto& each : a) each = random.word();
    a[0] = 0;
    a[1] = a[a.size() - 1] = 0xffffffffu;
    for (const std::uint32_t factor : {0xD2511F53u, 0xCD9E8D57u, 0xffffffffu, 1u, 0u}) {
      program_of("lanes.cl", v).run("products", a.size(), a, factor, out(high), out(low));
      for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint64_t product = std::uint64_t(a[i]) * factor;
        REQUIRE(high[i] == product >> 32);
        REQUIRE(low[i] == (product & 0xffffffffu));
      }
    }
  }
}

// Multiples of b and their neighbours, up to the largest a.
TEST_CASE("lanes: quotients of integers are rounded down") {
  Random random(9);
  for (const Variant v : variants) {
    CAPTURE(v);
    const auto program = program_of("lanes.cl", v);
    for (const std::int64_t b : {1,
                                 2,
                                 3,
                                 5,
                                 7,
                                 16,
                                 41,
                                 47,
                                 255,
                                 256,
                                 257,
                                 1000,
                                 1009,
                                 1920,
                                 4095,
                                 4096,
                                 4097,
                                 8191,
                                 65535,
                                 65537,
                                 (1 << 24) - 1,
                                 (1 << 24) + 1,
                                 (1 << 29) + 1,
                                 0x3fffffff}) {
      const std::int64_t above = std::min((std::int64_t(1) << 31) - b, b << 22); // a and quotients are less
      std::vector<int> a = {0, static_cast<int>(b - 1), static_cast<int>(b), static_cast<int>(above - 1)};
      while (a.size() < lanes_of(v)) {
        const auto multiple =
            static_cast<std::int64_t>(random.uniform(0, 1) * static_cast<double>(above)) / b * b;
        const std::int64_t near = multiple + static_cast<int>(random.word() % 3) - 1;
        a.push_back(static_cast<int>(std::clamp(near, std::int64_t(0), above - 1)));
      }
      std::vector<int> got(a.size());
      program.run("quotients", a.size(), a, static_cast<int>(b), out(got));
      for (std::size_t i = 0; i < a.size(); ++i) {
        CAPTURE(a[i], b);
        REQUIRE(got[i] == a[i] / b);
      }
    }
  }
}

TEST_CASE("lanes: times_sign, larger, smaller") {
  Random random(7);
  for (const Variant v : variants) {
    CAPTURE(v);
    auto x = random_reals(lanes_of(v), random), sign = random_reals(lanes_of(v), random);
    sign[0] = 0.0f;
    sign[1] = -0.0f;
    x[2] = std::numeric_limits<float>::infinity();
    std::vector<float> product(x.size()), larger(x.size()), smaller(x.size());
    program_of("lanes.cl", v).run("signs", x.size(), x, sign, out(product), out(larger), out(smaller));
    for (std::size_t i = 0; i < x.size(); ++i) {
      REQUIRE(product[i] == (std::signbit(sign[i]) ? -x[i] : x[i]));
      REQUIRE(larger[i] == std::max(x[i], sign[i]));
      REQUIRE(smaller[i] == std::min(x[i], sign[i]));
    }
  }
}

TEST_CASE("lanes: masks combine and select, and what is not selected does not matter") {
  struct Selections {
    int both, either, not_less, none, all, real, whole, vec;
  };
  Random random(8);
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<float> a(lanes_of(v)), b(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = static_cast<float>(random.word() % 21) - 10;
      b[i] = static_cast<float>(random.word() % 21) - 10;
    }
    std::vector<Selections> got(a.size());
    program_of("lanes.cl", v).run("masks", a.size(), a, b, out(got));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool less = a[i]<b[i], positive = a[i]> 0;
      REQUIRE(got[i].both == (less && positive));
      REQUIRE(got[i].either == (less || positive));
      REQUIRE(got[i].not_less == !less);
      REQUIRE(got[i].none == 0);
      REQUIRE(got[i].all == 1);
      REQUIRE(got[i].real == static_cast<int>(less ? a[i] : b[i]));
      REQUIRE(got[i].whole == got[i].real);
      REQUIRE(got[i].vec == static_cast<int>((a[i] + b[i] + 2) * (less ? 1.0f : 2.0f)));
    }
  }
}

TEST_CASE("lanes: cos_sin_turns is right to 2 ulp of the larger of the two, and to 2 ulp of each") {
  std::vector<float> turns;
  const std::size_t steps = thinned(std::size_t(1) << 20);
  for (std::size_t i = 0; i <= steps; ++i)
    turns.push_back(static_cast<float>(static_cast<double>(i) / static_cast<double>(steps)));
  for (int eighth = 0; eighth <= 8; ++eighth) { // where the polynomials change
    float below = static_cast<float>(eighth) / 8, above = below;
    for (int step = 0; step < 64; ++step) {
      turns.push_back(std::max(below = std::nextafter(below, -1.0f), 0.0f));
      turns.push_back(std::min(above = std::nextafter(above, 2.0f), 1.0f));
    }
  }
  for (const Variant v : variants) {
    CAPTURE(v);
    std::vector<float> cosine(turns.size()), sine(turns.size());
    program_of("turns.cl", v).run("turns", turns.size(), turns, out(cosine), out(sine));
    double of_larger = 0, of_own = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      // Reduced exactly to an eighth of a turn, where the error of the host's functions is a fraction of an
      // ulp of float32.
      const double quarters = std::nearbyint(4.0 * turns[i]);
      const double rest = (turns[i] - quarters / 4) * 2 * std::numbers::pi;
      const int quadrant = static_cast<int>(quarters) & 3;
      const double c = std::cos(rest), s = std::sin(rest);
      const double right_cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
      const double right_sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
      for (const auto& [got, right] : {std::pair(cosine[i], right_cosine), std::pair(sine[i], right_sine)}) {
        const double error = std::abs(got - right);
        of_larger = std::max(of_larger, error / std::exp2(-24)); // ulp of numbers in [0.5, 1)
        if (std::abs(right) > std::numeric_limits<float>::min())
          of_own = std::max(of_own, error / std::exp2(std::ilogb(right) - 23));
        else
          REQUIRE(error <= std::abs(right));
      }
    }
    CAPTURE(of_larger, of_own);
    CHECK(of_larger <= 2.0);
    CHECK(of_own <= 2.0);
  }
}
