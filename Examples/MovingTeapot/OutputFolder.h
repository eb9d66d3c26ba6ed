// SPDX-License-Identifier: BSD-3-Clause
/** Where a program puts what it makes, and whether it can draw. */
#pragma once

#include <string>

namespace movingteapot
{

/**
 * Makes the folder, with those above it, and removes what an earlier run left there: the files, and
 * then the empty folders, whose path from there is matched by `ours` (ECMAScript). All else stays.
 * Throws std::runtime_error that names the folder.
 */
void PrepareFolder(const std::string& folder, const std::string& ours);

/** Puts ParaViewState.py, which opens the results in ParaView, into the folder. Throws
    std::runtime_error. */
void AddParaViewState(const std::string& folder);

/**
 * Whether VTK can open a window. If not, a line on the standard error stream says so: where VTK
 * draws by X, it ends the program if DISPLAY is not set.
 */
bool CanDraw();

}
