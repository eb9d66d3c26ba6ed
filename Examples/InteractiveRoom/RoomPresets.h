// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Room.h"

namespace interactiveroom
{

/** The names that MakePreset takes. */
const std::vector<std::string>& PresetNames();

/**
 * "room": a lit room with five things; "oven": the belt of the curing oven, with the machine parts
 * that Data/fetch.sh gets, if they are there; "aisle": racks of a warehouse, with a truck and
 * goods.
 */
Room MakePreset(const std::string& name);

}
