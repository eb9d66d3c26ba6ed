// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DiffusingFields_h
#define irradiance_DiffusingFields_h

#include "Estimates/CellDiffusion.h"
#include "Execution/SlicedPass.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

/// Some fields on their way through a diffusion, side by side.
struct DiffusingFields
{
  std::size_t object;                 ///< whose they are
  std::uint32_t first;                ///< number of the first
  unsigned count;                     ///< that are used
  std::vector<double> quanta, before; ///< see CellDiffusion::step
  int stepsDone = 0;

  unsigned width() const { return count == 1 ? 1 : CellDiffusion::kFields; }
};

/// Appends the fields 0 to `count` of an object.
inline void addFields(std::size_t object, std::uint32_t count, std::vector<DiffusingFields>& all)
{
  for (std::uint32_t first = 0; first < count; first += CellDiffusion::kFields)
  {
    all.push_back({ object, first, std::min(count - first, CellDiffusion::kFields), {}, {} });
  }
}

/// Takes fields through all steps. `diffusionOf`: an object's diffusion. `begin` fills some that
/// are empty, `end` reads them; many threads call these.
template <class DiffusionOf, class Begin, class End>
void diffuse(std::vector<DiffusingFields>& all, const DiffusionOf& diffusionOf, const Begin& begin,
  const End& end, Execution& execution)
{
  runSliced(all.size(), execution, [&](std::size_t i, const Deadline& deadline) {
    DiffusingFields& fields = all[i];
    const CellDiffusion& diffusion = diffusionOf(fields.object);
    if (fields.quanta.empty())
    {
      begin(fields);
    }
    while (fields.stepsDone < diffusion.steps())
    {
      diffusion.step(fields.stepsDone, fields.width(), fields.quanta, fields.before);
      ++fields.stepsDone;
      if (deadline.hasPassed())
      {
        return false;
      }
    }
    end(fields);
    fields.quanta = fields.before = {};
    return true;
  });
}

}

#endif
