# SPDX-License-Identifier: BSD-3-Clause
"""Light groups by Python's dicts."""


def set_light_group_factors(irradiance, factors):
    """By how much the lamps of each light group shine: {"tube": 0.5, "ceiling": (1, 0.8, 0.6)}.

    A factor is one number, or three for three bands; groups that are not named have 1. Nothing is shot for it. Anything
    else than such numbers, finite and 0 or more, is a ValueError, and changes nothing.
    """
    checked = {str(group): _bands(group, factor) for group, factor in factors.items()}
    irradiance.RemoveAllLightGroupFactors()
    for group, bands in checked.items():
        irradiance.SetLightGroupFactor(group, *bands)


def _bands(group, factor):
    bands = [float(band) for band in factor] if hasattr(factor, "__len__") else [float(factor)] * 3
    if not group or len(bands) != 3 or not all(0 <= band < float("inf") for band in bands):
        raise ValueError(f"light group {group!r}: the factor {factor!r}; a name is needed, and one number or three, "
                         "finite and 0 or more")
    return bands
