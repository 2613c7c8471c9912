// Tests that methods agree on a scene, although the samples of some have heavy tails.
//
// Each method renders the scene 16 times with few samples; two methods are compared by Welch's t-tests (1947)
// of every channel of the image and of its tiles. If they differ, the scene is rendered again with other
// seeds and 8 times as many samples, up to twice: in standard errors a bias grows, while the skewness of
// means of rare bright samples, which invalidates a t-test, decreases. For normal means, all tests of a scene
// together, with Sidak's correction, fail by chance with probability 0.05, 0.01 and 10^-4 at the three
// stages; a false alarm requires all three and has probability 5 10^-8. If a method has doubts() or infinite
// variance it is 10^-4 at each stage.
//
// A method with doubts() may lack rare large samples for any practical number of samples; it is then too
// dark, never too bright. If it is darker than a method without doubts, the two are not comparable. If it is
// darker than another with doubts, either may be wrong: the pair is undecided. A method without doubts() that
// is the darker one always fails.
//
// A defect that only darkens methods with doubts would never be found. Therefore such a scene is also
// rendered as its twin (twin.h), in which no method has doubts and every pair must agree.
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

/// Compares methods on one scene. Seeds begin with 10^6 x `seed`; `samples_per_pixel` is that of each of the
/// first 16 renders.
[[nodiscard]] SceneAgreement agreement_of_methods(const scene::Scene& scene,
                                                  const std::vector<render::Settings>& methods,
                                                  std::uint64_t seed, int samples_per_pixel);

/// Compares `methods` of methods_of_family() on a random scene, and on its twin if it has one.
[[nodiscard]] std::vector<SceneAgreement> agreement_with_twin(const SceneNumber& number, int methods,
                                                              int samples_per_pixel);

/// Largest share of pairs that may be excused in the scenes of this number of families. It was 4.6% of 12,000
/// pairs of 50 families when all twins agreed. The standard deviation over families is 8.6%; three standard
/// errors are allowed, but at most an eighth, so that most pairs are compared.
[[nodiscard]] double most_excused(std::size_t families);

} // namespace phlux::test
