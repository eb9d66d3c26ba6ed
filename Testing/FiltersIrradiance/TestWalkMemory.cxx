// SPDX-License-Identifier: BSD-3-Clause
// Walks that cannot fit into memory are an error before one is shot.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkCallbackCommand.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

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
  vtkNew<vtkIrradianceFilter> filter;
  const auto reports = ErrorObserver::Watch(filter);
  Connect(filter, MakeSmallScene());
  filter->SetDirectLight(vtkIrradianceFilter::Shot);
  filter->SetNumberOfWalks(100000000);
  filter->Update();
  ASSERT_EQ(reports->Errors.size(), 1u);
  for (const char* word : { "NumberOfWalks is 100000000", "at least 3200 MB", "2147 MB" })
  {
    EXPECT_NE(reports->Errors[0].find(word), std::string::npos) << reports->Errors[0];
  }
  reports->Clear();
  filter->SetNumberOfWalks(1000);
  filter->Update();
  EXPECT_TRUE(reports->Errors.empty());
}

// Without movers no walk is stored.
TEST(WalkMemory, IsNotAskedForWhereNothingIsStored)
{
  const AddressLimit limit(rlim_t{ 2 } << 30);
  vtkNew<vtkIrradianceFilter> filter;
  const auto reports = ErrorObserver::Watch(filter);
  Scene scene = MakeSmallScene();
  scene.Moving.clear();
  Connect(filter, scene);
  filter->SetDirectLight(vtkIrradianceFilter::Shot);
  filter->SetNumberOfWalks(100000000);
  // The first report of progress from the walks stops it.
  const auto stop = vtkSmartPointer<vtkCallbackCommand>::New();
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void* progress) {
    if (*static_cast<double*>(progress) > 0)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  EXPECT_TRUE(reports->Errors.empty());
}
