#ifndef irradiance_Replicates_h
#define irradiance_Replicates_h

#include <cstdint>

namespace irradiance
{

/// Deals walks out to replicates in turn: walk w is number w / R of replicate w mod R. So the first
/// n walks are shared evenly for every n; the first n mod R replicates have one more.
class ReplicateDeal
{
public:
  explicit ReplicateDeal(std::uint32_t replicates = 1)
    : replicates_(replicates)
  {
  }

  std::uint32_t replicates() const { return replicates_; }
  std::uint32_t replicateOf(std::uint32_t walk) const
  {
    return replicates_ == 1 ? 0 : walk % replicates_;
  }
  std::uint32_t numberWithin(std::uint32_t walk) const
  {
    return replicates_ == 1 ? walk : walk / replicates_;
  }
  /// How many of the first `walks` walks a replicate has.
  std::uint32_t share(std::uint32_t replicate, std::uint32_t walks) const
  {
    return walks / replicates_ + (replicate < walks % replicates_ ? 1 : 0);
  }

private:
  std::uint32_t replicates_;
};

}

#endif
