// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdEvents_h
#define irradiance_KdEvents_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// Where items begin, end, or lie flat on one axis, in ascending order.
class KdEvents
{
public:
  /// All events at one place.
  struct Step
  {
    float x;
    std::uint32_t ending, lying, beginning;
  };

  void clear();
  /// Adds the requested events of an item. A flat item has only one event.
  void add(float lower, float upper, bool takesLower, bool takesUpper)
  {
    if (takesLower)
    {
      (lower == upper ? flats_ : begins_).places.push_back(lower);
    }
    if (takesUpper && lower != upper)
    {
      ends_.places.push_back(upper);
    }
  }
  void sort();
  /// After sort(): goes to the next place; false if there is none.
  bool next(Step& step);

private:
  struct Sequence
  {
    std::vector<float> places;
    std::size_t position = 0;

    void sort();
    bool isFinished() const { return position == places.size(); }
    void lower(float& x) const;
    std::uint32_t pass(float x);
  };

  Sequence begins_, ends_, flats_;
};

}

#endif
