// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel of the diffusion includes this once, between the marks of its
// target.

namespace irradiance
{
namespace
{

/// One number, on any machine.
struct PlainNumbers
{
  using Numbers = double;
  static constexpr unsigned kCount = 1;

  static Numbers all(double value) { return value; }
  static Numbers load(const double* values) { return *values; }
  static void store(double* values, Numbers numbers) { *values = numbers; }
  static Numbers truncated(Numbers numbers) { return __builtin_trunc(numbers); }
};

template <class Lanes, unsigned kFields>
inline void flowAcross(
  const CellDiffusion::Link* links, std::size_t count, const double* before, double* quanta)
{
  for (const CellDiffusion::Link* link = links; link != links + count; ++link)
  {
    const std::size_t a = std::size_t{ link->a } * kFields, b = std::size_t{ link->b } * kFields;
    const auto shareOfA = Lanes::all(link->shareOfA), shareOfB = Lanes::all(link->shareOfB);
    for (unsigned k = 0; k < kFields; k += Lanes::kCount)
    {
      const auto across = Lanes::truncated(
        shareOfA * Lanes::load(before + a + k) - shareOfB * Lanes::load(before + b + k));
      Lanes::store(quanta + a + k, Lanes::load(quanta + a + k) - across);
      Lanes::store(quanta + b + k, Lanes::load(quanta + b + k) + across);
    }
  }
}

/// `Lanes`: for many fields; a single one takes its numbers one by one.
template <class Lanes>
inline void flowBy(const CellDiffusion::Link* links, std::size_t count, unsigned fields,
  const double* before, double* quanta)
{
  fields == 1 ? flowAcross<PlainNumbers, 1>(links, count, before, quanta)
              : flowAcross<Lanes, CellDiffusion::kFields>(links, count, before, quanta);
}

}
}
