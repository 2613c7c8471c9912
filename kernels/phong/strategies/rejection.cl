// Rejection sampling of f_r cos, with proposals of density cos / pi and a bound on f_r.
#include "phong/whole.h"

static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real bound = fma(fma(m.exponent, (Real)(0.5f), (Real)(1.0f)), m.specular_max, m.diffuse_max);
  RandomWords words = random.words;
  Vec3 direction = cosine_direction(uniform_real(words.y), uniform_real(words.z));
  Mask drawing = active;
  Int draws = (Int)(1);
  for (uint draw = 1;; ++draw) {
    const Vec3 proposal = cosine_direction(uniform_real(words.y), uniform_real(words.z));
    direction = vec_select(drawing, proposal, direction);
    const Real value = fma(phong_lobe(m, fixed, proposal), m.specular_max, m.diffuse_max);
    drawing &= (uniform_real(words.w) * bound >= value) & (bound > 0.0f);
    if (!any_lane(drawing)) break;
    draws += drawing ? (Int)(1) : (Int)(0);
    words = draw_again(random, draw);
  }
  LobeSample s = whole_sample(m, fixed, direction, phong_shares(m, phong_lobe_reflectivity(m, fixed.z)));
  s.draws = draws;
  return s;
}
