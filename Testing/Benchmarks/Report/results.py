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

    def goal(self, limit):
        sign = "<=" if self.aim < self.bar else ">="
        return "" if math.isnan(limit) else f"{sign} {number(limit)}"

    def reached(self):
        if math.isnan(self.bar):
            return ""
        sign = -1 if self.aim < self.bar else 1
        reaches = lambda limit: sign * self.median >= sign * limit
        return "aim" if reaches(self.aim) else "bar" if reaches(self.bar) else "no"


def number(value):
    """Three significant digits, or a dash for what is not a number."""
    return "-" if math.isnan(value) else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def read(paths):
    """{table: {(row, quantity): Result}}, all in the order in which they first come."""
    tables = {}
    for path in paths:
        with open(path, newline="", encoding="utf-8") as file:
            for table, row, quantity, *numbers in csv.reader(file):
                value, bar, aim = map(float, numbers)
                results = tables.setdefault(table, {})
                results.setdefault((row, quantity), Result(bar, aim)).values.append(value)
    return tables


def distinct(values):
    """Without repetitions, in the order in which they first come."""
    return list(dict.fromkeys(values))


def rows_of(results):
    return distinct(row for row, _ in results)


def quantities_of(results):
    return distinct(quantity for _, quantity in results)


def cell(result):
    """The median and half the range in percent; the range itself where the median is 0."""
    if result is None:
        return ""
    if result.median == 0 and max(result.values) > 0:
        return result.range()
    extent = max(result.values) - min(result.values)
    return number(result.median) + (f" ±{50 * extent / result.median:.0f}%" if extent > 0 else "")


def markdown(heading, rows):
    lines = [f"| {' | '.join(line)} |\n" for line in [heading] + rows]
    return "".join([lines[0], "|---" * len(heading) + "|\n"] + lines[1:])


def table(results):
    """As Markdown: a line for each result with its range and goal; or, when none has a goal and there
    are several quantities, rows by quantities."""
    quantities = quantities_of(results)
    if len(quantities) > 1 and all(math.isnan(result.bar) for result in results.values()):
        return markdown([""] + quantities,
                        [[row] + [cell(results.get((row, quantity))) for quantity in quantities]
                         for row in rows_of(results)])
    return markdown(["", "quantity", "median", "range", "bar", "aim", "reached"],
                    [[row, quantity, number(one.median), one.range(), one.goal(one.bar),
                      one.goal(one.aim), one.reached()] for (row, quantity), one in results.items()])


if __name__ == "__main__":
    for name, results in read(sys.argv[1:]).items():
        print(f"\n{name}\n{table(results)}", end="")
