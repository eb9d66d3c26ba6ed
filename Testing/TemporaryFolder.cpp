// SPDX-License-Identifier: BSD-3-Clause
// Tests run side by side, each in a process of its own, and some write files of the same names. So
// each process has a folder of its own as testing::TempDir(), which goes when it ends.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace
{

class TemporaryFolder : public testing::Environment
{
public:
  void SetUp() override
  {
    path_ = testing::TempDir() + "vtkIrradiance-XXXXXX";
    ASSERT_TRUE(mkdtemp(path_.data())) << path_;
    setenv("TEST_TMPDIR", path_.c_str(), 1);
    ASSERT_EQ(testing::TempDir(), path_ + "/");
  }

  void TearDown() override
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

private:
  std::string path_;
};

const testing::Environment* const temporaryFolder =
  testing::AddGlobalTestEnvironment(new TemporaryFolder);

}
