// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the whole Update() of vtkIrradianceFilter goes in a frame, output included: a room in which
 * one ball moves, or 200 small ones do. One thread, wall clock. In the first frame the output has
 * to equal a new filter's.
 *
 * Arguments: [walks = 1000000] [frames = 20]
 */
#include "../../FiltersIrradiance/TestScenes.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"

#include "vtkSMPTools.h"
#include "vtkTimerLog.h"

#include <stdexcept>

using namespace TestScenes;

namespace
{

constexpr double kSide = 4;

class BallRoom
{
public:
  BallRoom(int balls, double radius, vtkIdType walks)
    : room_(MakeRoom(kSide, 20))
    , lamp_(MakeLamp({ 0.5 * kSide, 0.5 * kSide, 0.95 * kSide }, 1, { 100 }))
    , ball_(MakeBall(radius, balls == 1 ? 24 : 8))
    , walks_(walks)
    , poses_(static_cast<std::size_t>(balls))
  {
    move(0);
    connect(filter_);
  }

  /// Each ball circles around its own place.
  void move(int frame)
  {
    for (std::size_t i = 0; i < poses_.size(); ++i)
    {
      // Spread evenly (Roberts 2018: the generalized golden ratio).
      const double number = static_cast<double>(i), angle = 0.3 * frame + number;
      const auto place = [number](double step) {
        const double x = 0.5 + number * step;
        return kSide * (0.2 + 0.6 * (x - std::floor(x)));
      };
      poses_[i]->Identity();
      poses_[i]->Translate(place(0.8191725134) + 0.05 * std::cos(angle),
        place(0.6710436067) + 0.05 * std::sin(angle), place(0.5497004779));
    }
  }

  double update() { return update(filter_); }

  double cost(const char* name) const
  {
    return filter_->GetOutput()->GetFieldData()->GetArray(name)->GetTuple1(0);
  }

  void check()
  {
    vtkNew<vtkIrradianceFilter> fresh;
    connect(fresh);
    update(fresh);
    for (unsigned int port = 0; port < 2; ++port)
    {
      vtkMultiBlockDataSet *ours = blocksOf(filter_, port), *theirs = blocksOf(fresh, port);
      for (unsigned int i = 0; i < ours->GetNumberOfBlocks(); ++i)
      {
        vtkDataArray *a = irradianceOf(ours, i), *b = irradianceOf(theirs, i);
        for (vtkIdType cell = 0; cell < a->GetNumberOfTuples(); ++cell)
        {
          if (a->GetTuple1(cell) != b->GetTuple1(cell))
          {
            throw std::runtime_error("The answers differ");
          }
        }
      }
    }
  }

private:
  void connect(vtkIrradianceFilter* filter)
  {
    filter->SetNumberOfWalks(walks_);
    filter->SetDirectLightToShot();
    filter->AddInputDataObject(0, room_);
    filter->AddInputDataObject(0, lamp_);
    for (std::size_t i = 0; i < poses_.size(); ++i)
    {
      filter->AddInputDataObject(1, ball_);
      filter->SetDynamicTransform(static_cast<int>(i), poses_[i]);
    }
  }
  /// Seconds.
  static double update(vtkIrradianceFilter* filter)
  {
    const double start = vtkTimerLog::GetUniversalTime();
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ 1, "Sequential", false }, [filter] { filter->Update(); });
    return vtkTimerLog::GetUniversalTime() - start;
  }
  static vtkMultiBlockDataSet* blocksOf(vtkIrradianceFilter* filter, unsigned int port)
  {
    return vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput()->GetBlock(port));
  }
  static vtkDataArray* irradianceOf(vtkMultiBlockDataSet* blocks, unsigned int i)
  {
    auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(i));
    return block->GetCellData()->GetArray("Irradiance");
  }

  Mesh room_, lamp_, ball_;
  vtkIdType walks_;
  std::vector<vtkNew<vtkTransform>> poses_;
  vtkNew<vtkIrradianceFilter> filter_;
};

void profile(const std::string& row, int balls, double radius, vtkIdType walks, int frames)
{
  BallRoom scene(balls, radius, walks);
  const double first = scene.update();
  for (int frame = 1; frame <= frames; ++frame)
  {
    scene.move(frame);
    const double whole = scene.update();
    if (frame == 1)
    {
      scene.check();
    }
    const double verification = scene.cost("VerifySeconds"), repair = scene.cost("RepairSeconds");
    const auto share = [&](const char* what, double seconds) {
      report("FrameProfile", row, what, 100 * seconds / whole);
    };
    report("FrameProfile", row, "ms", 1000 * whole);
    report("FrameProfile", row, "first update / frame", first / whole);
    report("FrameProfile", row, "walks changed, %",
      100 * scene.cost("NumberOfInvalidWalks") / scene.cost("NumberOfWalks"));
    share("verification, %", verification);
    share("repair, %", repair);
    share("inputs and output, %", whole - verification - repair);
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, vtkIdType{ 1000000 });
  const int frames = arguments.number(1, 20);
  profile("1 ball of 0.4 m", 1, 0.4, walks, frames);
  profile("200 balls of 0.04 m", 200, 0.04, walks, frames);
}
