"""Evaluates sampling.csv: what each strategy costs, which one is the most efficient in each case, and by what factor.

A case is a material, exponent and angle of incidence under one kind of light. The efficiency of an estimator is
1 / (variance x cost) (Veach 1997, chapter 2).
"""
import math
from collections import Counter, defaultdict

import chart_style as style
import numpy as np

STRATEGIES = ("uniform", "theta-phi", "cosine", "disk", "rejection", "lobe-ks", "lobe-estimate-printed", "lobe-estimate",
              "lobe-rho", "mixture", "fold", "exact")
LIGHTS = {
    "constant": "constant light",
    "mirror-disk": "a bright disk about the mirror direction",
    "horizon-sky": "a sky that is bright at the horizon",
}
LARGEST_MARGIN = 1000  # ratios above are shown as this
SMALLEST_MARGIN = 1.02  # ratios below count as a tie
ROUNDING = 1e-6  # relative standard deviation that float32 rounding gives a constant estimate


class CostModel:
    """The cost of a sample: with or without Russian roulette where the strategy has it, and ray_cost per ray that is traced
    on, in samples of lobe-ks."""

    def __init__(self, title, roulette, ray_cost):
        self.title, self.roulette, self.ray_cost = title, roulette, ray_cost

    def cost(self, row):
        """Nanoseconds per sample, rays included."""
        return row.ns_per_sample + self.ray_cost * row.unit_time * row.rays_per_sample

    def relative_error(self, row):
        """Relative standard error of variance x cost. That of a median time is taken as a quarter of the range over the
        rounds, divided by the root of their number."""
        of_variance = row.variance_standard_error / row.variance if row.variance > 0 else 0
        of_time = (row.ns_most - row.ns_least) / 4 / math.sqrt(row.rounds) / self.cost(row)
        return math.hypot(of_variance, of_time)


# About what a ray through half a million triangles costs (bench/PERFORMANCE.md).
RAY_COST = 20
COST_MODELS = (CostModel("roulette, rays are free", True, 0),
               CostModel(f"roulette, a ray costs {RAY_COST} samples", True, RAY_COST),
               CostModel(f"no roulette, a ray costs {RAY_COST} samples", False, RAY_COST))


def read_rows(folder):
    """The rows of sampling.csv, with roulette in those strategies that have it, and the rows of all strategies without
    roulette."""
    rows, without = style.read(folder, "sampling.csv"), style.read(folder, "sampling-no-roulette.csv")
    no_roulette = [row for row in rows if row.roulette == 0] + without
    for row in rows + without:
        row.marks = row.marks.split() if isinstance(row.marks, str) else []
        row.material = (row.kd, row.ks)
        row.cell = (row.n, row.theta_deg)
        row.case = (row.material, row.cell, row.integrand)
    times = defaultdict(list)
    measured = {row.strategy for row in rows}
    for row in rows:
        if row.strategy == "lobe-ks" or "lobe-ks" not in measured:
            times[row.case].append(row.ns_per_sample)
    for row in rows + without:
        row.unit_time = float(np.median(times[row.case]))
    return rows, no_roulette


def grid_of(rows):
    """The exponents and the angles such that every combination was measured."""
    angles = defaultdict(set)
    for row in rows:
        angles[row.n].add(row.theta_deg)
    most = max(map(len, angles.values()))
    exponents = sorted(n for n in angles if len(angles[n]) == most)
    return exponents, sorted(set.intersection(*(angles[n] for n in exponents)))


def materials_of(rows):
    """The materials that were measured over a grid, with its exponents and angles."""
    grids = {}
    for material in dict.fromkeys(row.material for row in rows):
        exponents, angles = grid_of([row for row in rows if row.material == material])
        if len(exponents) > 1 and len(angles) > 1:
            grids[material] = exponents, angles
    return grids


def relative_cost(row):
    """Nanoseconds of sampling until the variance of the mean equals the square of the mean."""
    return row.variance / row.exact**2 * row.ns_per_sample


def ranked(rows, model):
    """(variance x cost, row) of the unmarked rows, the most efficient first. A variance below that of float32 rounding counts
    as that."""
    entries = [(max(row.variance, (ROUNDING * row.exact) ** 2) * model.cost(row), row) for row in rows if not row.marks]
    return sorted(entries, key=lambda entry: entry[0])


def margin_of(entries, model):
    """Variance x cost of the second best over that of the best, and whether it is significant: above two standard errors."""
    if len(entries) < 2:
        return LARGEST_MARGIN, True
    (best, first), (second, other) = entries[:2]
    margin = min(LARGEST_MARGIN, second / best)
    error = math.hypot(model.relative_error(first), model.relative_error(other))
    return margin, margin > SMALLEST_MARGIN and math.log(margin) > 2 * error


def relative_products(rows, model):
    """For each strategy: variance x cost over that of the best strategy, in every case in which it has no marks; and the number
    of cases in which it is the best."""
    cases, ratios, wins = defaultdict(list), defaultdict(list), Counter()
    for row in rows:
        cases[row.case].append(row)
    for of_case in cases.values():
        entries = ranked(of_case, model)
        if entries:
            wins[entries[0][1].strategy] += 1
            for product, row in entries:
                ratios[row.strategy].append(product / entries[0][0])
    return ratios, wins


def relative_times(rows):
    """For each strategy: time per sample over that of lobe-ks in the same case."""
    times = defaultdict(list)
    for row in rows:
        times[row.strategy].append(row.ns_per_sample / row.unit_time)
    return times
