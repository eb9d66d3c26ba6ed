# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the pages."""

import math

import matplotlib

matplotlib.use("Agg")  # no display
from matplotlib import pyplot

from results import distinct


def write(figure, axes, path):
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def bars(results, title, path):
    """The medians: a group of bars for each quantity, a colour for each row but the one that is the
    unit of the others: it alone is 1 everywhere, and has no goal."""
    groups = distinct(quantity for _, quantity in results)
    series = {row: [results[row, group].median if (row, group) in results else 0 for group in groups]
              for row, _ in results}
    units = [row for row, values in series.items()
             if set(values) == {1} and all(math.isnan(results[row, group].bar) for group in groups)]
    if len(units) == 1:
        del series[units[0]]
    figure, axes = pyplot.subplots(figsize=(12, 5.2), layout="constrained")
    width = 0.8 / len(series)
    colours = pyplot.get_cmap("Paired" if len(series) <= 12 else "tab20")
    for i, (row, values) in enumerate(series.items()):
        places = [group - 0.4 + (i + 0.5) * width for group in range(len(groups))]
        axes.bar(places, values, width, label=row, color=colours(i))
    axes.set_xticks(range(len(groups)), groups)
    axes.set_ylabel(title)
    write(figure, axes, path)


def lines(results, bottom, left, path):
    """The medians of two quantities against each other; "log" before one asks for a logarithmic axis.
    Rows with the same text before their last comma are points of one line, or a mark if there is only
    one; those with the same text before their first comma have the same colour, those with the same
    text between the two the same dashes or mark."""
    figure, axes = pyplot.subplots(figsize=(12, 5.2), layout="constrained")
    x, y = bottom.removeprefix("log "), left.removeprefix("log ")
    rows_of = {}
    for row in distinct(row for row, _ in results):
        rows_of.setdefault(row.rpartition(",")[0], []).append(row)
    groups, kinds = (distinct(name.partition(",")[i] for name in rows_of) for i in (0, 2))
    for name, rows in rows_of.items():
        group, _, kind = name.partition(",")
        mark = "DsPX"[kinds.index(kind) % 4]
        dashes = ["-", "--", ":", "-."][kinds.index(kind) % 4]
        style = ({"marker": "o", "linestyle": dashes} if len(rows) > 1
                 else {"marker": mark, "linestyle": "", "markersize": 12})
        axes.plot([results[row, x].median for row in rows], [results[row, y].median for row in rows],
                  color=pyplot.get_cmap("Dark2")(groups.index(group)), label=name, clip_on=False, **style)
    axes.set(xlabel=x, ylabel=y, xscale="log" if x != bottom else "linear",
             yscale="log" if y != left else "linear")
    if x == bottom:
        axes.set_xlim(left=0)
    if y == left:
        axes.set_ylim(bottom=0)
    write(figure, axes, path)
