// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectSources_h
#define irradiance_DirectSources_h

#include "Walks/LightSurvey.h"
#include "Walks/WalkSource.h"

#include <vector>

namespace irradiance
{

/**
 * Where cells gather direct light: for each source one whose walks start at static cells, and one
 * for each of the other cellParts(). Lights that are better known otherwise have sources of their
 * own, whose walks start at the lights, as the survey of the same sources says. Walks are shared as
 * among groups. About as many walks start at cells as the plan has, if the light falls on static
 * cells that reflect as all of them on average.
 */
std::vector<WalkSource> directSourcesOf(const SceneObjects& objects,
  const std::vector<WalkSource>& sources, const LightSurvey& survey,
  const FewestSamples& fewestSamples);

/// Makes the lights of sources known to what asks them: it takes a while, and once for all parts of
/// the cells is enough.
void addLamps(std::vector<WalkSource>& sources);

}

#endif
