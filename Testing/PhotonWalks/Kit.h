// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_Kit_h
#define irradiance_test_Kit_h

// What most tests need: scenes, engines, executions, and what an engine answers.

#include "DirectRuns.h"
#include "EngineRun.h"
#include "HistoryPhotons.h"
#include "Scenes.h"
#include "TestScenes.h"
#include "ThreadExecution.h"
#include "Views.h"

#include "../RayCasting/RandomVectors.h"
#include "../RayCasting/TestSimdLevels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#endif
