// Exact sampling of f_r cos: the diffuse part with the density cos / pi, the lobe with that of cos^n(alpha) cos(theta).
#include "phong/whole.h"

// A direction with density cos^n(alpha) cos(theta), normalised (sampling.md). In longitude psi and latitude beta of the
// mirror frame the density separates into cos^(n + 2)(beta) and cos^n(psi) cos(psi + theta). The latter is the sum of a
// part (a) that is even in psi and a part (b) at the edge of the clamped region. `coin` chooses between the parts, and
// is rescaled and used again within the part.
static inline Vec3 exact_direction(Phong m, Vec3 fixed, Real reflectivity, RandomDraws random, Mask active,
                                   Int* draws) {
  const Real coin = uniform_real(random.words.w);
  const MirrorFrame frame = mirror_frame(fixed);
  const Real c = frame.cosine, s = frame.sine;
  const Real sine_power = exp((0.5f * m.exponent + 1.0f) * log1p(-smaller(c * c, (Real)(1.0f)))); // s^(n + 2)
  const Real share_b = m.grazing_reflectivity * sine_power / reflectivity;
  const Mask in_b = active & (coin < share_b);
  Vec3 v = cosine_power_direction(m.exponent + 1.0f, uniform_real(random.words.y), uniform_real(random.words.z));
  Vec3 chosen = v;
  if (any_lane(in_b)) {
    // b: cos(psi) = s u^(1 / (n + 1)), towards the normal, at the same latitude.
    const Real minus_fall = expm1(2.0f * log(coin / share_b) / (m.exponent + 1.0f));
    const Real cos_beta = sqrt((1.0f - v.y) * (1.0f + v.y));
    const Vec3 b = vec3(-cos_beta * sqrt(fma(-s * s, minus_fall, c * c)), v.y, cos_beta * s * lobe_cosine(minus_fall));
    chosen = vec_select(in_b, b, chosen);
  }
  // a: v or its mirror image about psi = 0, in proportion to their heights; if the lower one is below the surface, half
  // of the draws are rejected.
  Mask drawing = active & !in_b;
  Real again = (coin - share_b) / (1.0f - share_b);
  *draws = (Int)(1);
  for (uint draw = 1;; ++draw) {
    const Real side = fabs(v.x) * s, up = fma(v.z, c, side), down = fma(v.z, c, -side);
    const Real share_up = down > 0.0f ? up / (up + down) : (Real)(0.5f);
    const Mask takes_up = again < share_up;
    const Mask accepted = drawing & (takes_up | (down > 0.0f));
    chosen = vec_select(accepted, vec3(takes_up ? -fabs(v.x) : fabs(v.x), v.y, v.z), chosen);
    drawing &= !accepted;
    if (!any_lane(drawing)) break;
    const RandomWords words = draw_again(random, draw);
    v = cosine_power_direction(m.exponent + 1.0f, uniform_real(words.y), uniform_real(words.z));
    again = uniform_real(words.w);
    *draws += drawing ? (Int)(1) : (Int)(0);
  }
  return from_mirror_frame(frame, chosen);
}

static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const Real reflectivity = phong_lobe_reflectivity(m, fixed.z);
  const PhongShares shares = phong_shares(m, reflectivity);
  const Mask from_lobe = active & (choice * (shares.diffuse + shares.specular) >= shares.diffuse);
  Vec3 direction = cosine_direction(uniform_real(random.words.y), uniform_real(random.words.z));
  Int draws = (Int)(1);
  if (any_lane(from_lobe)) {
    const Vec3 specular = exact_direction(m, fixed, reflectivity, random, from_lobe, &draws);
    direction = vec_select(from_lobe, specular, direction);
  }
  LobeSample s = whole_sample(m, fixed, direction, shares);
  s.draws = draws;
  return s;
}
