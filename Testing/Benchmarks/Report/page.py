# SPDX-License-Identifier: BSD-3-Clause
"""Fills a template with the results of the benchmark programs.

    page.py TEMPLATE PAGE VERSIONS FILE.csv...      pictures go to the folder pictures/ beside the page

A line of the template with nothing else is replaced if it is one of these:

    {{machine}}               the machine, the versions (the text of VERSIONS), the date
    {{table NAME}}            a table
    {{data NAME}}             a link to the table, which goes to the folder measured/ beside the page
    {{chart NAME: TITLE}}     its picture with bars, TITLE at the axis of values
    {{lines NAME: X | Y}}     its picture with lines, quantity Y over quantity X, see charts.lines
    {{further results}}       all tables that are not named before

and these within a text, which is then wrapped again:

    {{value NAME | ROW | QUANTITY}}      the median
    {{scenes NAME | ROW | QUANTITY}}     the medians of the rows "SCENE, ROW" of all scenes
"""

import os
import pathlib
import platform
import re
import sys
import textwrap
import time

import charts
import results


def machine(versions):
    path = pathlib.Path("/proc/cpuinfo")
    processor = path.read_text() if path.exists() else ""
    model = re.search("model name.*: (.*)", processor)
    simd = "AVX-512" if "avx512f" in processor else "AVX2" if "avx2" in processor else "SSE2"
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") >> 30
    return (f"* Processor: {model[1] if model else platform.machine()}, {os.cpu_count()} logical "
            f"processors; SIMD: {simd}; memory: {memory} GiB\n"
            f"* System: {platform.system()} {platform.release()}\n"
            f"{versions}* Date: {time.strftime('%Y-%m-%d', time.gmtime())}")


class Page:
    def __init__(self, tables, versions, folder):
        self.tables, self.versions = tables, versions
        self.pictures, self.measured = folder / "pictures", folder / "measured"
        self.named = set()

    def table(self, name):
        self.named.add(name)
        if name not in self.tables:  # its meshes were not there
            return "(Not measured in this run.)"
        return results.table(self.tables[name]).rstrip()

    def data(self, name):
        if name not in self.tables:
            return self.table(name)
        self.named.add(name)
        results.write(self.tables[name], self.measured / f"{name}.csv")
        return f"All rows: [{name}.csv]({self.measured.name}/{name}.csv)."

    def picture(self, draw, name, *titles):
        if name not in self.tables:
            return ""
        draw(self.tables[name], *titles, self.pictures / f"{name}.png")
        title = " over ".join(reversed(titles)).replace("log ", "")
        return f"![{title}]({self.pictures.name}/{name}.png)"

    def figure(self, kind, name, title):
        if kind == "machine":
            return machine(self.versions)
        if kind == "table":
            return self.table(name)
        if kind == "data":
            return self.data(name)
        if kind == "chart":
            return self.picture(charts.bars, name, title)
        if kind == "lines":
            return self.picture(charts.lines, name, *title.split(" | "))
        if kind == "further":
            names = [name for name in self.tables if name not in self.named]
            return "\n\n".join(f"## {name}\n\n{self.table(name)}" for name in names)
        raise KeyError(f"no such placeholder: {kind}")

    def medians(self, match):
        kind, name, row, quantity = match.groups()
        found = [result for (one, what), result in self.tables.get(name, {}).items()
                 if what == quantity and row == (one if kind == "value" else one.partition(", ")[2])]
        if not found:
            raise KeyError(f"no result {name} | {row} | {quantity}")
        *first, last = [results.number(result.median) for result in found]
        return f"{', '.join(first)} and {last}" if first else last

    def block(self, text):
        """A paragraph, an item of a list, or a figure."""
        figure = re.fullmatch(r"\{\{(\w+) ?([^:|}]*)(?:: (.*))?\}\}", text)
        if figure:
            return self.figure(*figure.groups())
        filled, count = re.subn(r"\{\{(value|scenes) (\w+) \| ([^|]*?) ?\| ([^}]*)\}\}", self.medians,
                                " ".join(text.split()))
        if count == 0:
            return text
        together = filled.replace(" %", "\0%")  # no line begins with a unit
        indent = "  " if text.startswith("* ") else ""
        return textwrap.fill(together, 100, subsequent_indent=indent,
                             break_on_hyphens=False).replace("\0", " ")


def main(template, page, versions, *measurements):
    page = pathlib.Path(page)
    for name in ("pictures", "measured"):
        (page.parent / name).mkdir(exist_ok=True)
    filler = Page(results.read(measurements), pathlib.Path(versions).read_text(), page.parent)
    parts = re.split(r"(\n\n|\n(?=\* ))", pathlib.Path(template).read_text(encoding="utf-8").strip())
    text = "".join(map(filler.block, parts))
    if "{{" in text:
        raise KeyError(f"not understood: {text[text.index('{{'):][:80]}")
    page.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
