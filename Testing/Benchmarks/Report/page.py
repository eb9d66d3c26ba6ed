"""Fills a template with the results of the benchmark programs.

    page.py TEMPLATE PAGE VERSIONS FILE.csv...      pictures go to the folder pictures/ beside the page

A line of the template with nothing else is replaced if it is one of these:

    {{machine}}               the machine, the versions (the text of VERSIONS), the date
    {{table NAME}}            a table
    {{chart NAME: TITLE}}     its picture with bars, TITLE at the axis of values
    {{lines NAME: X | Y}}     its picture with lines, quantity Y over quantity X, see charts.lines
    {{further results}}       all tables that are not named before

and these within a text, which is then wrapped anew:

    {{value NAME | ROW | QUANTITY}}      the median
    {{scenes NAME | ROW | QUANTITY}}     the medians of all rows "SCENE, ROW", one for each scene
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
    def __init__(self, tables, versions, pictures):
        self.tables, self.versions, self.pictures = tables, versions, pictures
        self.named = set()

    def table(self, name):
        self.named.add(name)
        if name not in self.tables:  # its meshes were not there
            return "(Not measured in this run.)"
        return results.table(self.tables[name]).rstrip()

    def picture(self, draw, name, title, *texts):
        if name not in self.tables:
            return ""
        draw(self.tables[name], *texts, self.pictures / f"{name}.png")
        return f"![{title}]({self.pictures.name}/{name}.png)"

    def figure(self, kind, name, title):
        if kind == "machine":
            return machine(self.versions)
        if kind == "table":
            return self.table(name)
        if kind == "chart":
            return self.picture(charts.bars, name, title, title)
        if kind == "lines":
            x, y = title.split(" | ")
            return self.picture(charts.lines, name, f"{y} over {x}".replace("log ", ""), x, y)
        if kind == "further":
            return "\n\n".join(f"## {name}\n\n{self.table(name)}"
                               for name in self.tables if name not in self.named)
        raise KeyError(f"no such placeholder: {kind}")

    def medians(self, match):
        kind, name, row, quantity = match.groups()
        found = [result for (one, what), result in self.tables.get(name, {}).items()
                 if what == quantity and (one == row or kind == "scenes" and one.endswith(", " + row))]
        if not found:
            raise KeyError(f"no result {name} | {row} | {quantity}")
        medians = [results.number(result.median) for result in found]
        return " and ".join(filter(None, [", ".join(medians[:-1]), medians[-1]]))

    def block(self, text):
        """A paragraph, an item of a list, or a figure."""
        figure = re.fullmatch(r"\{\{(\w+) ?([^:}]*)(?:: (.*))?\}\}", text)
        if figure and figure[1] not in ("value", "scenes"):
            return self.figure(*figure.groups())
        # Spaces that may be lines' ends: a long placeholder is wrapped like other text.
        filled, count = re.subn(r"\{\{(value|scenes)\s+(\w+)\s+\|\s+([^|]*)\s\|\s+([^}]*)\}\}",
                                self.medians, text)
        if count == 0:
            return text
        together = filled.replace(" %", "\0%")  # no line begins with a unit
        return textwrap.fill(" ".join(together.split()), 100, break_on_hyphens=False,
                             subsequent_indent="  " if text.startswith("* ") else "").replace("\0", " ")


def main(template, page, versions, *measurements):
    page = pathlib.Path(page)
    pictures = page.parent / "pictures"
    pictures.mkdir(exist_ok=True)
    filler = Page(results.read(measurements), pathlib.Path(versions).read_text(), pictures)
    parts = re.split(r"(\n\n|\n(?=\* ))", pathlib.Path(template).read_text().strip())
    page.write_text("".join(map(filler.block, parts)) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
