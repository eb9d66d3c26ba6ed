// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace irradiance
{

void WalkBatch::begin(const WalkTracer& tracer, WalkHistory* history)
{
  tracer_ = &tracer;
  history_ = history;
  areHitsKnown_ = false;
  notesPlaces_ = false;
  now_.size = next_.size = waiting_.size = 0;
  rounds_ = 0;
  segments_ = 0;
  places_.clear();
}

void WalkBatch::start(FrontTally& tally)
{
  started_ = now_.size;
  tracer_->stages().start(now_);
  // Direct light that cells gathered was tallied as absorbed; the part that they reflect is not.
  tracer_->startsAtCells() ? tally.release(now_) : tally.emit(now_);
}

void WalkBatch::resume(bool notesPlaces)
{
  started_ = now_.size;
  areHitsKnown_ = true;
  notesPlaces_ = notesPlaces;
}

/// After the first rounds it shows whether walks of a closed scene end too seldom. From n bounces
/// for each that ends, cells receive n times the emitted power, and checkReceived() allows 2^16. Of
/// 4096 walks 16 should have ended at that; if walks take half as many bounces, 7 million such
/// batches refuse one by chance.
void WalkBatch::checkEnds() const
{
  constexpr double kFewest = 12, kFarBelow = 0.4;
  const double expected = static_cast<double>(segments_) * 0x1p-16;
  const std::size_t ended = started_ - now_.size;
  if (expected >= kFewest && static_cast<double>(ended) < kFarBelow * expected)
  {
    throw std::runtime_error("of " + std::to_string(started_) + " walks " + std::to_string(ended) +
      " ended in their first " + std::to_string(rounds_) +
      " bounces: the light cannot leave a part of the scene that hardly absorbs any, as the "
      "reflectances there are too near 1. Above 0.99998 such a scene cannot be computed");
  }
}

/// Goes on with walks that wait, from the end.
bool WalkBatch::isDone()
{
  if (rounds_ == kRoundsTogether)
  {
    checkEnds();
  }
  if (rounds_ >= kRoundsTogether && now_.size > kPatient)
  {
    waiting_.take(now_, 0, now_.size - kPatient);
    next_.size = 0;
    next_.take(now_, now_.size - kPatient, kPatient);
    std::swap(now_, next_);
  }
  if (now_.size == 0 && waiting_.size > 0)
  {
    const std::size_t count = std::min(waiting_.size, kPatient);
    now_.take(waiting_, waiting_.size - count, count);
    waiting_.size -= count;
  }
  return now_.size == 0;
}

bool WalkBatch::run(FrontTally& tally, const std::function<bool()>& hasToStop)
{
  const WalkStages& stages = tracer_->stages();
  for (; !isDone(); ++rounds_)
  {
    if (hasToStop())
    {
      return false;
    }
    if (!areHitsKnown_)
    {
      tracer_->cast(now_, cast_);
    }
    areHitsKnown_ = false;
    segments_ += static_cast<std::int64_t>(now_.size);
    stages.findSides(now_);
    tally.receive(now_);
    tally.check();
    if (history_)
    {
      store();
    }
    stages.absorb(now_, next_);
    tally.release(next_);
    stages.leave(next_);
    std::swap(now_, next_);
  }
  return true;
}

void WalkBatch::store()
{
  kinds_.need(now_.size);
  history_->setKinds(now_.hit.data(), now_.size, kinds_.data());
  for (std::size_t row = 0; tracer_->hasContacts() && row < now_.size; ++row)
  {
    if (tracer_->isContact(now_.start[row], now_.hit[row]))
    {
      kinds_[row] = BounceColumns::kContact;
    }
  }
  BounceColumns columns{
    { { now_.originX.data(), now_.originY.data(), now_.originZ.data() },
      { now_.directionX.data(), now_.directionY.data(), now_.directionZ.data() },
      now_.distance.data() },
    now_.walk.data(), now_.parent.data(), now_.hit.data(),
    { now_.weightB.data(), now_.weightC.data() }, kinds_.data(), now_.hitSide.data(), {}
  };
  for (int band = 0; history_->bands() > 1 && band < history_->bands(); ++band)
  {
    columns.powers[band] = now_.power[band].data();
  }
  const std::uint32_t* const blocks = now_.block.data();
  for (std::size_t row = 0, end = 0; row < now_.size; row = end)
  {
    end = row + 1;
    while (end < now_.size && blocks[end] == blocks[row])
    {
      ++end;
    }
    history_->block(blocks[row]).append(columns, row, end - row, now_.slot.data() + row);
  }
  for (std::size_t row = 0; notesPlaces_ && row < now_.size; ++row)
  {
    places_.push_back({ blocks[row], now_.slot[row] });
  }
  notesPlaces_ = false;
}

}
