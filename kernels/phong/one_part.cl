// Strategies that choose one part of the model, the diffuse part or the lobe, and sample it by its own density (CW 197,
// 3.3.2). A strategy defines phong_estimate(m, fixed, random), the value of the reflectivity rho_s / ks of the lobe
// that it uses in the choice and in roulette; phong_expected(m, cosine), the mean of this value; and two constants:
//   PHONG_WHOLE_WEIGHT 1: the weight is f_r cos / density of the whole model; 0: that of the chosen part alone.
//   PHONG_FOLD 1: a lobe sample below the surface is mirrored to above.
#ifndef PHLUX_PHONG_ONE_PART_CL
#define PHLUX_PHONG_ONE_PART_CL

#include "phong/shares.h"

static inline Real phong_survival(Phong m, Vec3 fixed, RandomDraws random) {
  return phong_survival_for(m, phong_estimate(m, fixed, random));
}

// Density of the lobe if samples below the surface are mirrored about psi = 0: it is doubled where the mirror image is
// below the surface. That is where z c + x s in the mirror frame is negative; with x = -(p, q) . w c - s w.z and
// z = -(p, q) . w s + c w.z this is -2 c s (p, q) . w + (c^2 - s^2) w.z.
static inline Real folded_density(Vec3 fixed, Vec3 generated, Real density) {
  const MirrorFrame f = mirror_frame(fixed);
  const Real along = fma(f.p, generated.x, f.q * generated.y);
  const Real image = fma(-2.0f * f.cosine * f.sine, along, (f.cosine - f.sine) * (f.cosine + f.sine) * generated.z);
  return generated.z > 0.0f ? (image < 0.0f ? 2.0f * density : density) : (Real)(0.0f);
}

// If phong_estimate is random, this is the density for its mean, which is sufficient for weights of other techniques.
static inline Real phong_density(Phong m, Vec3 fixed, Vec3 generated, Real lobe) {
  const PhongShares shares = phong_shares(m, phong_expected(m, fixed.z));
  Real density = lobe * (m.exponent + 1.0f) / (m.exponent + 2.0f); // times pi
  if (PHONG_FOLD) density = folded_density(fixed, generated, density);
  const Real sum = fma(larger(generated.z, (Real)(0.0f)), shares.diffuse, density * shares.specular);
  return ratio_or_zero(sum * INV_PI, shares.diffuse + shares.specular);
}

static inline LobeSample phong_sample(Phong m, Vec3 fixed, Real choice, RandomDraws random, Mask active) {
  const PhongShares shares = phong_shares(m, phong_estimate(m, fixed, random));
  const Real total = shares.diffuse + shares.specular;
  const Real u1 = uniform_real(random.words.y), u2 = uniform_real(random.words.z);
  const Mask from_lobe = choice * total >= shares.diffuse;
  Vec3 v = cosine_power_direction(m.exponent, u1, u2);
  const MirrorFrame frame = mirror_frame(fixed);
  if (PHONG_FOLD) v.x = mirror_frame_height(frame, v) < 0.0f ? -v.x : v.x;
  const Vec3 direction = vec_select(from_lobe, from_mirror_frame(frame, v), cosine_direction(u1, u2));
  const Real lobe = phong_lobe(m, fixed, direction);
  LobeValue whole;
  whole.value = phong_value(m, lobe);
  whole.density = phong_density(m, fixed, direction, lobe);
  LobeSample s = lobe_sample(direction, whole);
  if (PHONG_WHOLE_WEIGHT) return s;
  // The chosen part, divided by its own density and its probability.
  const Real of_lobe = total / shares.specular * (m.exponent + 2.0f) / (m.exponent + 1.0f) * direction.z;
  const Vec3 of_part = vec_select(from_lobe, vec_scale(of_lobe, m.specular_reflectance),
                                  vec_scale(total / shares.diffuse, m.diffuse_reflectance));
  s.weight = vec_select(total > 0.0f, of_part, vec_all((Real)(0.0f)));
  return s;
}

#endif
