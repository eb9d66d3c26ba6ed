// SPDX-License-Identifier: BSD-3-Clause
// Walks that cannot fit into memory are an error before one is shot.

#include "ErrorObserver.h"
#include "EventObserver.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <limits>

using namespace TestScenes;

namespace
{

/// Of the address space of this process, while it lives.
class AddressLimit
{
public:
  explicit AddressLimit(rlim_t bytes)
  {
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &limit);
  }
  AddressLimit(const AddressLimit&) = delete;
  AddressLimit& operator=(const AddressLimit&) = delete;
  ~AddressLimit() { setrlimit(RLIMIT_AS, &this->Before); }

private:
  rlimit Before;
};

}

// 100 million walks of at least one segment of 32 bytes take 3.2 GB.
TEST(WalkMemory, IsAskedForBeforeWalksAreShot)
{
  const AddressLimit limit(rlim_t{ 2 } << 30);
  const auto filter = MakeFilter(MakeSmallScene(), 100000000);
  ExpectOne(Update(filter).Errors, { "NumberOfWalks is 100000000", "at least 3200 MB", "2147 MB" });
  filter->SetNumberOfWalks(1000);
  EXPECT_TRUE(Update(filter).Errors.empty());
}

// Without movers no walk is stored.
TEST(WalkMemory, IsNotAskedForWhereNothingIsStored)
{
  const AddressLimit limit(rlim_t{ 2 } << 30);
  const auto filter = MakeFilter({ MakeSmallScene().Fixed, {} }, 100000000);
  // The first report of progress from the walks stops it.
  EventObserver::Watch(filter)->AbortFrom = std::numeric_limits<double>::min();
  EXPECT_TRUE(Update(filter).Errors.empty());
}
