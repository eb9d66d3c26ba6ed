# SPDX-License-Identifier: BSD-3-Clause
"""The measurements that the benchmark programs write (see Measuring/Results.h), as tables.

    results.py FILE.csv...      prints their tables
"""

import csv
import math
import statistics
import sys


class Result:
    """All rounds of one measurement, and its goal."""

    def __init__(self, bar, aim):
        self.values, self.bar, self.aim = [], bar, aim

    @property
    def median(self):
        return statistics.median(self.values)

    def range(self):
        return f"{number(min(self.values))} .. {number(max(self.values))}"

    def short(self):
        """The median and half the range in percent; the range itself where the median is 0."""
        extent = max(self.values) - min(self.values)
        if self.median == 0 and extent > 0:
            return self.range()
        return number(self.median) + (f" ±{50 * extent / self.median:.0f}%" if extent > 0 else "")

    def long(self):
        """Median, range, bar, aim, and which of the two is reached."""
        if math.isnan(self.bar):
            return [number(self.median), self.range(), "", "", ""]
        sign, text = (-1, "<=") if self.aim < self.bar else (1, ">=")
        reached = [name for name, limit in (("aim", self.aim), ("bar", self.bar))
                   if sign * self.median >= sign * limit]
        return [number(self.median), self.range(), f"{text} {number(self.bar)}",
                f"{text} {number(self.aim)}", (reached + ["no"])[0]]


def number(value):
    """Three significant digits, or a dash for what is not a number."""
    return "-" if math.isnan(value) else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def read(paths):
    """{table: {(row, quantity): Result}}, all in the order in which they first come."""
    tables = {}
    for path in paths:
        with open(path, newline="", encoding="utf-8") as file:
            for table, row, quantity, value, bar, aim in csv.reader(file):
                results = tables.setdefault(table, {})
                result = results.setdefault((row, quantity), Result(float(bar), float(aim)))
                result.values.append(float(value))
    return tables


def distinct(values):
    """Without repetitions, in the order in which they first come."""
    return list(dict.fromkeys(values))


def cells(results):
    """A line for each result with its range and goal; or, when none has a goal and there are several
    quantities, rows by quantities. The heading comes first."""
    quantities = distinct(quantity for _, quantity in results)
    if len(quantities) > 1 and all(math.isnan(result.bar) for result in results.values()):
        lines = [["", *quantities]]
        for row in distinct(row for row, _ in results):
            lines.append([row, *(results[row, quantity].short() if (row, quantity) in results else ""
                                 for quantity in quantities)])
    else:
        lines = [["", "quantity", "median", "range", "bar", "aim", "reached"]]
        lines += [[*names, *result.long()] for names, result in results.items()]
    return lines


def table(results):
    """As Markdown."""
    heading, *lines = cells(results)
    lines = [heading, ["---"] * len(heading), *lines]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def write(results, path):
    """As comma-separated values."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(cells(results))


if __name__ == "__main__":
    for name, results in read(sys.argv[1:]).items():
        print(f"\n{name}\n{table(results)}", end="")
