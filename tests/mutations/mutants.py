"""Plausible mistakes in kernels/: (name, file, what stands there once, what a mistake puts there)."""

REDRAWS_PART = """again = uniform_real(words.w);
    if (any_lane(drawing & (again < share_b))) {
      const Mask to_b = drawing & (again < share_b);
      const Real fall = expm1(2.0f * log(again / share_b) / (m.exponent + 1.0f));
      const Real wide = sqrt((1.0f - v.y) * (1.0f + v.y));
      chosen = vec_select(to_b, vec3(-wide * sqrt(fma(-s * s, fall, c * c)), v.y, wide * s * lobe_cosine(fall)), chosen);
      drawing &= !to_b;
    }
    again = (again - share_b) / (1.0f - share_b);"""

MUTANTS = [
    ("n + 1 for n + 2 in f_r", "phong.cl", "fma(m.exponent, (Real)(0.5f), (Real)(1.0f)) * power",
     "fma(m.exponent, (Real)(0.5f), (Real)(0.5f)) * power"),
    ("pow for exp of log1p", "phong.cl", "exp(m.exponent * log1p(-one_minus_cosine))",
     "pow(1.0f - one_minus_cosine, m.exponent)"),
    ("f_r below the surface", "phong.cl", "const Mask above = (fixed.z > 0.0f) & (generated.z > 0.0f);",
     "const Mask above = generated.z == generated.z;"),
    ("f_r without 1 / pi", "phong.cl", "vec_select(above, vec_scale((Real)(PHONG_INV_PI), value)",
     "vec_select(above, vec_scale((Real)(1.0f), value)"),
    ("table not interpolated", "phong.cl", "v1 = gather_real(m.table, index + 1)", "v1 = gather_real(m.table, index)"),
    ("table index off by one", "phong.cl", "m.table_row + to_int(below);",
     "m.table_row + to_int(larger(below, (Real)(1.0f))) - 1;"),
    ("a part of the lobe for its whole", "phong.cl", "return position < (float)PHONG_TABLE_INTERVALS ? tabulated : cosine;",
     "return cosine;"),
    ("survival by the mean of the channels", "phong.cl", "shares.survival = vec_max(", "shares.survival = vec_mean("),
    ("survival not divided out (one part)", "phong.cl", "total / (survival * shares.specular)", "total / (shares.specular)"),
    ("survival not divided out (both parts)", "phong.cl", "direction.z / (density * survival), phong_eval(m, fixed, direction));\n  return",
     "direction.z / density, phong_eval(m, fixed, direction));\n  return"),
    ("the other lobe", "phong.cl", "vec_select(from_lobe, from_mirror_frame(frame, v), cosine_direction(u1, u2))",
     "vec_select(!from_lobe, from_mirror_frame(frame, v), cosine_direction(u1, u2))"),
    ("missing cosine in the weight of a lobe", "phong.cl", "(m.exponent + 2.0f) / (m.exponent + 1.0f) * s.direction.z;",
     "(m.exponent + 2.0f) / (m.exponent + 1.0f);"),
    ("weight kept below the surface", "phong.cl", "vec_select((s.direction.z > 0.0f) & (total > 0.0f)",
     "vec_select(total > 0.0f"),
    ("n + 2 for n + 1 in a lobe's density", "phong.cl", "* (m.exponent + 1.0f) / (m.exponent + 2.0f);", ";"),
    ("density for the wrong fixed direction", "phong.cl",
     "const PhongShares shares = phong_shares(m, fixed.z);\n  Real lobe =", "const PhongShares shares = phong_shares(m, generated.z);\n  Real lobe ="),
    ("fold's density without its mirror image", "phong.cl", "image < 0.0f ? 2.0f * lobe : lobe", "lobe"),
    ("fold does not fold", "phong.cl", "v.x = mirror_frame_height(frame, v) < 0.0f ? -v.x : v.x;", ""),
    ("guard of the estimate left out", "phong.cl", "return 0.5f + 0.5f * estimate;", "return estimate;"),
    ("estimate capped at 1/2", "phong.cl", "(Real)(0.0f), (Real)(1.0f));\n#if", "(Real)(0.0f), (Real)(0.5f));\n#if"),
    ("exact: missing cosine in the density", "phong.cl", "s.density = larger(direction.z, (Real)(0.0f)) * PHONG_INV_PI * value / total;",
     "s.density = PHONG_INV_PI * value / total;"),
    ("exact: n for n + 1", "phong.cl", "cosine_power_direction(m.exponent + 1.0f, u1, u2)", "cosine_power_direction(m.exponent, u1, u2)"),
    ("exact: n for n + 1 in redraws", "phong.cl", "cosine_power_direction(m.exponent + 1.0f, uniform_real",
     "cosine_power_direction(m.exponent, uniform_real"),
    ("exact: sign of psi in part b", "phong.cl", "vec3(-cos_beta * sqrt(", "vec3(cos_beta * sqrt("),
    ("exact: sine missing in part b", "phong.cl", "cos_beta * s * lobe_cosine(minus_fall)", "cos_beta * lobe_cosine(minus_fall)"),
    ("exact: half of the draws not refused", "phong.cl", "up / (up + down) : (Real)(0.5f)", "up / (up + down) : (Real)(1.0f)"),
    ("exact: wrong half", "phong.cl", "takes_up ? -fabs(v.x) : fabs(v.x)", "takes_up ? fabs(v.x) : -fabs(v.x)"),
    ("exact: sides with equal shares", "phong.cl", "down > 0.0f ? up / (up + down) : (Real)(0.5f)", "(Real)(0.5f)"),
    ("exact: share of part b not normalised", "phong.cl", "m.grazing_reflectivity * sine_power / reflectivity", "m.grazing_reflectivity * sine_power"),
    ("exact: s^n for s^(n + 2) in part b's share", "phong.cl", "(0.5f * m.exponent + 1.0f) * log1p", "(0.5f * m.exponent) * log1p"),
    ("exact: coin used twice", "phong.cl", "Real again = (coin - share_b) / (1.0f - share_b);", "Real again = coin;"),
    ("exact: part chosen anew at every redraw", "phong.cl", "again = uniform_real(words.w);", REDRAWS_PART),
    ("rejection: bound without the diffuse part", "phong.cl", "m.specular_max, m.diffuse_max);\n  const RandomWords first",
     "m.specular_max, (Real)(0.0f));\n  const RandomWords first"),
    ("uniform in theta for the cosine", "random_directions.h", "polar_direction(sqrt(1.0f - u1), sqrt(u1), u2)",
     "polar_direction(sqrt((1.0f - u1) * (1.0f + u1)), u1, u2)"),
    ("theta up to 45 degrees", "random_directions.h", "cos_sin_turns(0.25f * u1", "cos_sin_turns(0.125f * u1"),
    ("disk: half of the turns", "random_directions.h", "0.25f - 0.125f * (a / b)", "0.25f - 0.0625f * (a / b)"),
    ("lobe drawn with n + 2", "random_directions.h", "expm1(2.0f * log(u1) / (exponent + 1.0f))", "expm1(2.0f * log(u1) / (exponent + 2.0f))"),
    ("lobe drawn with pow", "random_directions.h", "expm1(2.0f * log(u1) / (exponent + 1.0f))", "(pow(u1, 2.0f / (exponent + 1.0f)) - 1.0f)"),
    ("p and q exchanged in the mirror frame", "frames.h", "f.p = tilted ? direction.x / f.sine", "f.p = tilted ? direction.y / f.sine"),
    ("sign of the mirror frame's z", "frames.h", "fma(f.cosine, v.x, f.sine * v.z)", "fma(f.cosine, v.x, -f.sine * v.z)"),
    ("sign of the mirror frame's x", "frames.h", "fma(f.cosine, v.z, -f.sine * v.x));", "fma(f.cosine, v.z, f.sine * v.x));"),
]
