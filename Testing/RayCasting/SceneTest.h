// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_SceneTest_h
#define irradiance_test_SceneTest_h

#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance::test
{

/// A test of one scene.
class SceneTest : public testing::TestWithParam<SceneMaker>
{
protected:
  const NamedScene named_ = GetParam().make();
};

}

#endif
