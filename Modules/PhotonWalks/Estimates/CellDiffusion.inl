// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel of the diffusion includes this once, between the marks of its
// target.

namespace irradiance
{
namespace
{

inline double truncated(double number)
{
  return __builtin_trunc(number);
}

// No lambda: GCC 12 compiles one without the instructions of the target.
template <class Numbers>
inline Numbers load(const double* from)
{
  Numbers numbers;
  __builtin_memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

/// `Numbers`: one, or a vector of several.
template <class Numbers, unsigned kFields>
inline void flowAcross(
  const CellDiffusion::Link* links, std::size_t count, const double* before, double* quanta)
{
  constexpr unsigned kBytes = sizeof(double), kTogether = sizeof(Numbers) / kBytes; // fields
  for (const CellDiffusion::Link* link = links; link != links + count; ++link)
  {
    const std::size_t a = std::size_t{ link->a } * kFields, b = std::size_t{ link->b } * kFields;
    for (unsigned k = 0; k < kFields; k += kTogether)
    {
      const Numbers across = truncated(link->shareOfA * load<Numbers>(before + a + k) -
        link->shareOfB * load<Numbers>(before + b + k));
      const Numbers ofA = load<Numbers>(quanta + a + k) - across;
      const Numbers ofB = load<Numbers>(quanta + b + k) + across;
      __builtin_memcpy(quanta + a + k, &ofA, sizeof ofA);
      __builtin_memcpy(quanta + b + k, &ofB, sizeof ofB);
    }
  }
}

/// `Numbers`: for many fields; a single one takes its numbers one by one.
template <class Numbers>
inline void flowBy(const CellDiffusion::Link* links, std::size_t count, unsigned fields,
  const double* before, double* quanta)
{
  fields == 1 ? flowAcross<double, 1>(links, count, before, quanta)
              : flowAcross<Numbers, CellDiffusion::kFields>(links, count, before, quanta);
}

}
}
