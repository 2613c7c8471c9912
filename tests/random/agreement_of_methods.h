// Whether methods agree about a scene, although some have heavy tails.
//
// Each method renders the scene 16 times with few samples; two methods are compared by Welch's t-tests (1947)
// of every channel of the image and of its tiles. What differs is rendered again, with other seeds and 8
// times as many samples, and again: a bias stays and grows in standard errors, while the skewness that makes
// a t-test of rare bright samples fail shrinks with their number. Where means are normal, all tests of a
// scene together, corrected after Sidak, fail at the three stages by chance with probability 0.05, 0.01 and
// 10^-4, and a false alarm, which takes all three, has that of 5 10^-8. Where a method has doubts() or
// infinite variance it is 10^-4 at each stage.
//
// A method with doubts() may miss what rare samples bring however many there are, which makes it too dark and
// never too bright. Where it is darker than a method without, the two are not comparable. Where it is darker
// than another with doubts, either may be wrong: the pair is undecided. A method without doubts() that is the
// darker one is never excused.
//
// A defect that only darkens methods in doubt would be excused always. Therefore a scene in doubt is rendered
// again as its twin (twin.h), in which no method is: there, every pair must agree.
#pragma once

#include <string>
#include <vector>

#include "random/methods.h"
#include "random/random_scene.h"
#include "scene/scene.h"

namespace phlux::test {

enum class Outcome { agree, not_comparable, undecided, disagree };

[[nodiscard]] const char* name_of(Outcome outcome);

struct PairOfMethods {
  std::string first, second, doubts; ///< names, and doubts() of the two
  Outcome outcome = Outcome::agree;
  int samples_per_pixel = 0; ///< of each render, where it was decided
  double z = 0;              ///< at first: (first - second) / standard error, of the means over the image
  double difference = 0;     ///< at first: (first - second) / second, of the same
  double p = 1;              ///< where it was decided: the least of all tests, corrected
  std::string worst;         ///< what that was a test of
};

struct SceneAgreement {
  std::string name; ///< of the scene or twin
  std::vector<PairOfMethods> pairs;
  bool dark = false;                ///< black by every method
  std::vector<std::string> defects; ///< values that are not numbers or negative, and errors
  [[nodiscard]] bool holds() const;
  [[nodiscard]] int excused() const;         ///< pairs that differ and yet do not disagree
  [[nodiscard]] std::string message() const; ///< what does not hold
};

/// Of one scene. Seeds begin with 10^6 x `seed`; `samples_per_pixel` are those of each of the first 16
/// renders.
[[nodiscard]] SceneAgreement agreement_of_methods(const scene::Scene& scene,
                                                  const std::vector<render::Settings>& methods,
                                                  std::uint64_t seed, int samples_per_pixel);

/// Of a random scene, by `methods` of methods_of_family(), and of its twin if it has one.
[[nodiscard]] std::vector<SceneAgreement> agreement_with_twin(const SceneNumber& number, int methods,
                                                              int samples_per_pixel);

/// The part of pairs that may be excused in the scenes of so many families. It was 4.6% of 12,000 pairs of 50
/// families when all twins agreed; shares of families scatter about it by 8.6%, of which three standard
/// errors are allowed. Never more than an eighth, or little is compared.
[[nodiscard]] double most_excused(std::size_t families);

} // namespace phlux::test
