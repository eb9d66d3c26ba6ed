// SPDX-License-Identifier: BSD-3-Clause
#ifndef OpenCells_h
#define OpenCells_h

#include "Rivals/PlainEmbree.h"

#include <vector>

/**
 * Whether light may reach the back of each cell. A back from which no ray of a few hits a front is
 * taken for the inside of a closed body or the outside of a room, which a user who bakes light
 * would leave out. That is a guess; where it is wrong, answers differ from those of a tracer that
 * shoots.
 */
std::vector<char> findOpenCells(const PlainScene& scene, const PlainEmbree& embree);

#endif
