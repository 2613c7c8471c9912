"""Reads the rankings of strategies that `phlux bench sampling` writes (sampling.ranking.csv, bench/README.md).

A case is a material, exponent and angle of incidence. In each case, under each kind of light, with and without roulette,
the strategies are ranked by variance x cost; the statistics are those of bench/sampling/sampling_ranking.cpp.
"""
from collections import defaultdict

import chart_style as style

# In the order of tables and colours; read() appends users' own.
STRATEGIES = ["uniform", "theta-phi", "cosine", "disk", "rejection", "lobe-ks", "lobe-estimate-printed", "lobe-estimate",
              "lobe-rho", "mixture", "fold", "exact"]
LIGHTS = {
    "constant": "constant light",
    "mirror-disk": "a bright disk about the mirror direction",
    "horizon-sky": "a sky that is bright at the horizon",
}
CONDITIONS = {0: "without roulette, the default before edge 5", 1: "with roulette at every bounce"}
WINNERS = ("best", "tied")
CONSTANT = 1e-12  # largest relative variance that is float32 rounding alone
LARGEST_FACTOR = 1000  # factors above are shown as this


def read(folder, name):
    rows = style.read(folder, name + ".ranking.csv")
    STRATEGIES.extend(dict.fromkeys(row.strategy for row in rows if row.strategy not in STRATEGIES))
    for row in rows:
        row.material = (row.kd, row.ks)
        row.cell = (row.n, row.theta_deg)
        row.compared = row.verdict in (*WINNERS, "slower")
    return rows


def groups_of(rows, key):
    groups = defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    return groups


def materials_of(rows):
    """The materials that were measured over a grid, with the exponents and angles of which every combination was measured."""
    grids = {}
    for material, of_material in groups_of(rows, lambda row: row.material).items():
        angles = {n: {row.theta_deg for row in some} for n, some in groups_of(of_material, lambda row: row.n).items()}
        most = max(map(len, angles.values()))
        exponents = sorted(n for n in angles if len(angles[n]) == most)
        common = sorted(set.intersection(*(angles[n] for n in exponents)))
        if len(exponents) > 1 and len(common) > 1:
            grids[material] = exponents, common
    return grids


def number_text(value):
    """Three digits at least; a power of ten where that is shorter."""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"
    mantissa, power = f"{value:.2e}".split("e")
    return f"{float(mantissa):g}e{int(power)}"


def factor_text(factor):
    return "≫" if factor > LARGEST_FACTOR else f"{factor:.{2 if factor < 10 else 0}f}"


def result_text(entries):
    """The result of one ranking: the best and its lead over the second, or the tied strategies."""
    compared = [row for row in entries if row.compared]
    winners = [row.strategy for row in compared if row.verdict in WINNERS]
    if not winners:
        return "too few samples to compare"
    if compared[0].relative_variance <= CONSTANT:
        return "best: " + " and ".join(winners) + ", without variance"
    if len(winners) > 1:
        return "tied: " + ", ".join(winners)
    if len(compared) < 2:
        return "the only one: " + winners[0]
    second = compared[1]
    interval = f"{factor_text(second.factor_least)} to {factor_text(second.factor_most)}"
    return f"best: {winners[0]}, {factor_text(second.factor)} ({interval}) times as efficient as {second.strategy}"
