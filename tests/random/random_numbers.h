// Random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace phlux::test {

class RandomNumbers {
public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double uniform() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  /// 0 < from < to
  double log_uniform(double from, double to) { return from * std::pow(to / from, uniform()); }
  int below(int count) { return static_cast<int>(uniform() * count); }
  bool chance(double probability) { return uniform() < probability; }
  template<class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[below(static_cast<int>(list.size()))];
  }

private:
  std::mt19937_64 engine_;
};

} // namespace phlux::test
