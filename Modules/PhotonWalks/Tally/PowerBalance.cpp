// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/PowerBalance.h"

#include <stdexcept>

namespace irradiance
{

PowerBalance& PowerBalance::operator+=(const PowerBalance& other)
{
  emitted += other.emitted;
  absorbed += other.absorbed;
  escaped += other.escaped;
  segments += other.segments;
  received += other.received;
  return *this;
}

void checkReceived(const PowerBalance& balance)
{
  if (balance.received > 0x1p62)
  {
    throw std::overflow_error("the cells receive more than 2^16 times the emitted power: the "
                              "reflectances of a closed scene are too near 1");
  }
}

void SharedBalance::add(const PowerBalance& part)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  total_ += part;
  checkReceived(total_);
}

}
