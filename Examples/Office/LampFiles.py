# SPDX-License-Identifier: BSD-3-Clause
"""Photometric files. A manufacturer's come from a goniophotometer; here formulas make up for one."""
import numpy as np


def panel_shape(gamma, c):
    """Downwards alone, dimmed above 60 degrees, as for screens; a square one is not quite round."""
    dimmed = 1 / (1 + (gamma / np.radians(64))**14)
    return np.maximum(np.cos(gamma), 0)**1.3 * dimmed * (1 + 0.06 * np.cos(4 * c) * np.sin(gamma)**2)


def pendant_shape(gamma, c):
    """Two fifths down, the others up to the ceiling, both more to the sides than along the lamp."""
    wide = 1 + 0.25 * np.cos(2 * c) * np.sin(gamma)**2
    down = np.maximum(np.cos(gamma), 0) * (1 + 0.8 * np.sin(gamma)**2) / (1 + (gamma / np.radians(65))**14)
    up = np.maximum(-np.cos(gamma), 0) * (0.7 + 2.4 * np.sin(gamma)**2)
    return wide * (0.9 * down + 0.6 * up)


def candelas(shape, lumens, gammas, planes):
    """A row for each C plane, with so much light in all."""
    gamma, c = np.meshgrid(np.radians(gammas), np.radians(planes))
    values = shape(gamma, c)
    zones = (values[:, 1:] + values[:, :-1]) / 2 * -np.diff(np.cos(gamma))
    return values * lumens / (2 * np.pi * zones.sum(axis=1).mean())


def rows_of(table):
    return "\n".join(" ".join(f"{value:.1f}" for value in row) for row in table)


def write_ies(path, lumens):
    """LM-63-2002: a square of 0.6 m, type C, lengths in m."""
    gammas, planes = np.arange(0, 91, 5), np.arange(0, 360, 15)  # 19 x 24
    table = candelas(panel_shape, lumens, gammas, planes)
    path.write_text(f"""IESNA:LM-63-2002
[TEST] none: a formula
[TESTLAB] vtkIrradiance, Examples/Office
[ISSUEDATE] 2024
[MANUFAC] nobody
[LUMCAT] PANEL-600
[LUMINAIRE] Recessed LED panel, 600 x 600 mm
TILT=NONE
1 -1 1 {len(gammas)} {len(planes) + 1} 1 2 0.6 0.6 0
1 1 36
{rows_of([gammas])}
{rows_of([[*planes, 360]])}
{rows_of([*table, table[0]])}
""", encoding="ascii")


def write_eulumdat(path, lumens):
    """A strip of 1.4 m x 80 mm that shines up and down; cd/klm of a quarter, as it is symmetric (4)."""
    gammas, planes = np.arange(0, 181, 10), np.arange(0, 360, 15)  # 19 x 24
    table = candelas(pendant_shape, 1000, gammas, planes)[:7]
    head = ["nobody", 2, 4, len(planes), 15, len(gammas), 10, "none: a formula", "LED pendant, direct and indirect",
            "PENDANT-1400", path.name, "2024", 1400, 80, 50, 1400, 80, 0, 0, 0, 0, 40, 100, 1, 0,
            1, -1, "LED", lumens, "4000 K", 80, 45, *[0] * 10]
    path.write_text("\n".join(str(item) for item in [*head, *planes, *gammas]) + "\n" +
                    rows_of(table).replace(" ", "\n") + "\n", encoding="ascii")
