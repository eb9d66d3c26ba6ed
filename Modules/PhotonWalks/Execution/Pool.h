// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Pool_h
#define irradiance_Pool_h

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace irradiance
{

/// Things that own much memory, to be used again by any thread: one at a time for each.
template <class Thing>
class Pool
{
public:
  /// As it was given back, or new.
  std::unique_ptr<Thing> take()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (things_.empty())
    {
      return std::make_unique<Thing>();
    }
    std::unique_ptr<Thing> thing = std::move(things_.back());
    things_.pop_back();
    return thing;
  }
  void giveBack(std::unique_ptr<Thing> thing)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    things_.push_back(std::move(thing));
  }

private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Thing>> things_;
};

}

#endif
