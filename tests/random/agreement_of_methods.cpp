#include "random/agreement_of_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>

#include <fmt/format.h>

#include "images/welch.h"
#include "measure/statistics.h"
#include "random/repeated_render.h"
#include "random/twin.h"

namespace phlux::test {
namespace {

constexpr int renders = 16;
// A failure of the first stage only leads to the second; methods with doubts often fail it.
constexpr std::array<double, 3> false_alarms = {0.05, 0.01, 1e-4};
constexpr double false_alarms_of_tails = 1e-4;
// Relative to the brightest light: leaks by rounding where surfaces cross or meet.
constexpr double negligible_radiance = 1e-9;
constexpr int growth = 8; // factor of the samples from one stage to the next

struct Worst {
  double p = 1; // corrected for the number of tests
  std::size_t quantity = 0;
};

// Variance of the mean of a quantity over all renders. If no sample was nonzero, nonzero samples are taken as
// Poisson events with the mean contribution of the image, sum of squares / sum: the variance of the mean is
// expected x contribution / samples.
double variance_of_mean(const RepeatedMeans& means, std::size_t quantity, double expected) {
  const std::size_t image = quantity % 3; // channel
  if (means.mean[quantity] > 0 || means.mean[image] <= 0) return means.variance[quantity] / means.renders;
  const double contribution_per_sample = means.variance[image] * means.pixels[image] / means.mean[image];
  return expected * contribution_per_sample / means.pixels[quantity] / means.renders;
}

// The least p-value of all tests of two methods, corrected for the number of tests of the scene. The few
// tests of the whole image and the many of its tiles each have half of the false-alarm rate.
Worst worst_of(const RepeatedMeans& a, const RepeatedMeans& b, std::size_t pairs, double negligible) {
  constexpr std::size_t of_image = 3;
  Worst worst;
  for (std::size_t q = 0; q < a.mean.size(); ++q) {
    if (std::max(a.mean[q], b.mean[q]) < negligible) continue;
    const double p = welch_p(a.mean[q], variance_of_mean(a, q, b.mean[q]), b.mean[q],
                             variance_of_mean(b, q, a.mean[q]), renders);
    const std::size_t alike = q < of_image ? of_image : a.mean.size() - of_image;
    const double of_all = measure::smallest_p(p, 2 * alike * pairs);
    if (of_all < worst.p) worst = {of_all, q};
  }
  return worst;
}

// Means of the three channels, which are correlated.
struct Overall {
  double mean = 0, standard_error = 0;
};
Overall overall(const RepeatedMeans& means) {
  Overall result;
  for (std::size_t c = 0; c < 3; ++c) {
    result.mean += means.mean[c] / 3;
    result.standard_error += std::sqrt(means.variance[c] / means.renders) / 3;
  }
  return result;
}

class Comparison {
public:
  Comparison(const scene::Scene& scene, std::vector<render::Settings> methods, std::uint64_t seed,
             int samples)
      : scene_(scene), facts_(facts_of(scene)), methods_(std::move(methods)), seed_(1'000'000 * seed),
        samples_(samples) {
    for (render::Settings& m : methods_) m = for_scene(m, scene, facts_);
  }

  SceneAgreement run() {
    std::vector<bool> all(methods_.size(), true);
    render(all, 0);
    result_.dark =
        std::ranges::all_of(means_, [](const RepeatedMeans& means) { return overall(means).mean == 0; });
    for (std::size_t i = 0; i < methods_.size(); ++i)
      for (std::size_t j = i + 1; j < methods_.size(); ++j) add_pair(i, j);
    for (std::size_t stage = 0; stage < false_alarms.size() && look_closer_; ++stage) {
      if (stage > 0) {
        samples_ *= growth;
        render(in_question(), stage);
      }
      judge(stage);
    }
    return std::move(result_);
  }

private:
  struct Question {
    std::size_t first, second;
    bool open = true;
  };

  void render(const std::vector<bool>& which, std::size_t stage) {
    means_.resize(methods_.size());
    for (std::size_t i = 0; i < methods_.size(); ++i) {
      if (!which[i]) continue;
      const RepeatedRender rendering(scene_, methods_[i]);
      means_[i] = rendering.means(seed_ + 100'000 * stage + 1000 * i, renders, samples_);
      if (!means_[i].defect.empty())
        result_.defects.push_back(fmt::format("{}: {}", name_of(methods_[i]), means_[i].defect));
    }
  }

  void add_pair(std::size_t i, std::size_t j) {
    PairOfMethods pair;
    pair.first = name_of(methods_[i]);
    pair.second = name_of(methods_[j]);
    const std::string a = doubts(methods_[i], facts_), b = doubts(methods_[j], facts_);
    pair.doubts = a + (a.empty() || b.empty() ? "" : "; ") + b;
    const Overall first = overall(means_[i]), second = overall(means_[j]);
    const double error = std::hypot(first.standard_error, second.standard_error);
    pair.z = error > 0 ? (first.mean - second.mean) / error : 0;
    pair.difference = second.mean > 0 ? (first.mean - second.mean) / second.mean : 0;
    result_.pairs.push_back(pair);
    questions_.push_back({i, j});
  }

  [[nodiscard]] std::vector<bool> in_question() const {
    std::vector<bool> which(methods_.size(), false);
    for (const Question& q : questions_)
      if (q.open) which[q.first] = which[q.second] = true;
    return which;
  }

  void judge(std::size_t stage) {
    look_closer_ = false;
    for (std::size_t k = 0; k < questions_.size(); ++k) {
      Question& question = questions_[k];
      if (!question.open) continue;
      const RepeatedMeans &a = means_[question.first], &b = means_[question.second];
      const Worst worst = worst_of(a, b, questions_.size(), negligible_radiance * facts_.brightest);
      PairOfMethods& pair = result_.pairs[k];
      pair.samples_per_pixel = samples_;
      pair.p = worst.p;
      pair.worst = fmt::format("{}: {:.5g} +- {:.2g}, {:.5g} +- {:.2g}", a.names[worst.quantity],
                               a.mean[worst.quantity], std::sqrt(a.variance[worst.quantity] / renders),
                               b.mean[worst.quantity], std::sqrt(b.variance[worst.quantity] / renders));
      pair.outcome = outcome_of(question, worst, level_of(question, stage));
      question.open = pair.outcome == Outcome::disagree || (stage == 0 && pair.outcome != Outcome::agree);
      look_closer_ |= question.open;
    }
  }

  [[nodiscard]] bool in_doubt(std::size_t method) const { return !doubts(methods_[method], facts_).empty(); }

  [[nodiscard]] double level_of(const Question& question, std::size_t stage) const {
    for (const std::size_t i : {question.first, question.second})
      if (in_doubt(i) || has_infinite_variance(methods_[i])) return false_alarms_of_tails;
    return false_alarms[stage];
  }

  [[nodiscard]] Outcome outcome_of(const Question& question, const Worst& worst, double level) const {
    if (worst.p >= level) return Outcome::agree;
    const bool first_is_darker =
        means_[question.first].mean[worst.quantity] < means_[question.second].mean[worst.quantity];
    const std::size_t darker = first_is_darker ? question.first : question.second;
    const std::size_t brighter = first_is_darker ? question.second : question.first;
    if (!in_doubt(darker)) return Outcome::disagree;
    return in_doubt(brighter) ? Outcome::undecided : Outcome::not_comparable;
  }

  const scene::Scene& scene_;
  SceneFacts facts_;
  std::vector<render::Settings> methods_;
  std::uint64_t seed_;
  int samples_; // per pixel of each render
  std::vector<RepeatedMeans> means_;
  std::vector<Question> questions_;
  SceneAgreement result_;
  bool look_closer_ = true;
};

} // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
  case Outcome::agree:
    return "agree";
  case Outcome::not_comparable:
    return "not comparable";
  case Outcome::undecided:
    return "undecided";
  default:
    return "disagree";
  }
}

bool SceneAgreement::holds() const {
  return defects.empty() && std::ranges::none_of(pairs, [](const PairOfMethods& pair) {
           return pair.outcome == Outcome::disagree;
         });
}

int SceneAgreement::excused() const {
  return static_cast<int>(std::ranges::count_if(pairs, [](const PairOfMethods& pair) {
    return pair.outcome == Outcome::not_comparable || pair.outcome == Outcome::undecided;
  }));
}

double most_excused(std::size_t families) {
  constexpr double usual = 0.046, scatter = 0.086, most = 0.125;
  return std::min(most, usual + 3 * scatter / std::sqrt(static_cast<double>(families)));
}

std::string SceneAgreement::message() const {
  std::string text;
  for (const std::string& defect : defects) text += defect + "\n";
  for (const PairOfMethods& pair : pairs)
    if (pair.outcome == Outcome::disagree)
      text += fmt::format("{} and {} disagree at {} samples a pixel: {}, p {:.2g}\n", pair.first, pair.second,
                          pair.samples_per_pixel, pair.worst, pair.p);
  return text.empty() ? "" : "scene " + name + ":\n" + text;
}

SceneAgreement agreement_of_methods(const scene::Scene& scene, const std::vector<render::Settings>& methods,
                                    std::uint64_t seed, int samples_per_pixel) try {
  return Comparison(scene, methods, seed, samples_per_pixel).run();
} catch (const std::exception& error) {
  SceneAgreement failed;
  failed.defects.push_back(error.what());
  return failed;
}

std::vector<SceneAgreement> agreement_with_twin(const SceneNumber& number, int methods,
                                                int samples_per_pixel) {
  const std::vector<render::Settings> by = methods_of_family(number.family, methods);
  const std::uint64_t seed = 1000 * number.family + number.member;
  std::vector<SceneAgreement> result;
  const auto compare = [&](const std::optional<Twin>& twin) {
    result.push_back(agreement_of_methods(load_random_scene(number, twin), by, seed, samples_per_pixel));
    result.back().name = name_of(number) + (twin ? " twin" : "");
  };
  compare({});
  if (const std::optional<Twin> twin = twin_of(number, by)) compare(twin);
  return result;
}

} // namespace phlux::test
