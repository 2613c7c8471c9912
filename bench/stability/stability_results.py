"""The rows of stability.csv as a grid of cells (lobe exponent, light radius), and how its methods compare."""
import math

import chart_style as style


class Result:
    """A row of stability.csv: one method in one cell."""

    def __init__(self, row, strategies):
        self.row = row
        self.variant = style.variant_of(row)
        self.method = self.variant if len(strategies) == 1 else f"{self.variant}, {row.strategy}"
        self.cell = (row.exponent, row.light_radius)
        self.sound = row.verdict == "sound"
        self.suspect = row.verdict in ("suspect", "undecided")
        self.refused = row.verdict == "refused"
        self.number = style.VARIANTS.index(self.variant) + len(style.VARIANTS) * strategies.index(row.strategy)

    @property
    def cost(self):
        """Microseconds to unit variance; a lower bound if the variance is suspect, and 0 if no sample found light."""
        return 1e6 * self.row.cost


class Grid:
    """All results, by method and by cell."""

    def __init__(self, rows):
        strategies = list(dict.fromkeys(row.strategy for row in rows))
        self.results = sorted((Result(row, strategies) for row in rows), key=lambda result: result.number)
        self.methods = list(dict.fromkeys(result.method for result in self.results))
        self.exponents = sorted({row.exponent for row in rows})
        self.radii = sorted({row.light_radius for row in rows})
        self.cells = [(n, radius) for n in self.exponents for radius in self.radii]

    def of(self, method):
        return [result for result in self.results if result.method == method]

    def ranked(self, cell):
        """The sound methods of a cell, the most efficient first."""
        return sorted((result for result in self.results if result.cell == cell and result.sound),
                      key=lambda result: result.cost)

    def suspects(self, cell):
        """The suspect and undecided methods of a cell whose lower bound is above 0, the least first."""
        return sorted((result for result in self.results if result.cell == cell and result.suspect and result.cost > 0),
                      key=lambda result: result.cost)

    def position(self, cell):
        """Column and row of a cell."""
        return self.exponents.index(cell[0]), self.radii.index(cell[1])

    def color(self, method, theme):
        return theme.color(self.of(method)[0].number)


def margin_of(ranked, suspects):
    """Time of the second best method over that of the best, and whether the best is known: the second is not tied with it, and
    no suspect or undecided method may need less time."""
    known = not any(result.row.rank == "open" for result in suspects)
    if len(ranked) < 2:
        return math.inf, known
    return ranked[1].row.cost_ratio, known and ranked[1].row.rank == "slower"


def best_of_another_integrator(ranked, suspects):
    """The best method of the other integrators, with its time over that of the best of all; its lower bound if none of them is
    sound."""
    for results, sign in ((ranked, ""), (suspects, "≥")):
        others = [result for result in results if result.row.integrator != ranked[0].row.integrator]
        if others:
            return f"{others[0].row.integrator} {sign}{ratio_text(others[0].cost / ranked[0].cost)}"
    return ""


def short_text(value):
    if value >= 1000:
        power = math.floor(math.log10(value))
        return f"{value / 10**power:.0f}e{power}" if round(value / 10**power) < 10 else f"1e{power + 1}"
    return f"{value:.0f}" if value >= 9.95 else f"{value:.1f}" if value >= 0.995 else f"{value:.2f}"


def ratio_text(value):
    return f"{value:.1g}" if value < 0.095 else f"{value:.2f}" if value < 1.995 else short_text(value)


def exponent_text(n):
    return f"{n:g}" if n < 1000 else f"{n:.0e}".replace("e+0", "e")
