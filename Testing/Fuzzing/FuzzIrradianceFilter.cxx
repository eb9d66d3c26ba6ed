// SPDX-License-Identifier: BSD-3-Clause
// Law: for any input the filter ends with one error, or with finite numbers, emitted = absorbed +
// escaped, and a warning if all is dark; and an update equals a rebuild, bit for bit. The same
// holds for the walks to look at, and for an eye and sensors that look at its photons. Bytes become
// inputs, transforms, settings and views, and then some frames in which something changes.

#include "FuzzedPolyData.h"
#include "FuzzedViews.h"

#include "../FiltersIrradiance/ShownWalks.h"

#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkOutputWindow.h"

namespace
{

using FuzzedPolyData::ByteReader;
using FuzzedViews::Fail;
using TestScenes::Mesh;

struct Inputs
{
  std::vector<Mesh> Ports[2];
  std::vector<vtkSmartPointer<vtkMatrixToLinearTransform>> Poses; ///< may be null
  vtkIdType NumberOfWalks = 16;
  int Seed = 1;
  int TraversalMode = 2;
  bool CacheStaticHits = true;
  bool SeparateSides = false;
  double DefaultDiffuseReflectance = 0.5;
  int Method = vtkIrradianceFilter::Walks;
  int NumberOfSpreadPhotons = 250;
  vtkIdType NumberOfOutputWalks = 0;
  vtkIdType OutputWalksCell = -1;
  FuzzedViews::View View;
};

void ReadPose(ByteReader& bytes, vtkMatrix4x4* matrix)
{
  const auto values = FuzzedPolyData::ReadMatrix(bytes);
  for (int i = 0; i < std::min<vtkIdType>(16, values->GetNumberOfValues()); ++i)
  {
    matrix->SetElement(i / 4, i % 4, values->GetValue(i));
  }
}

void ReadSettings(ByteReader& bytes, Inputs& inputs)
{
  const int kind = bytes.byte();
  // Few: where all light is reflected, the error comes only after about 2^16 bounces per walk.
  inputs.NumberOfWalks = bytes.oneIn(64) ? kind % 32 - 1 : 1 + kind % 8;
  inputs.Method = kind < 128 ? vtkIrradianceFilter::Walks
    : kind < 192             ? vtkIrradianceFilter::SpreadWalks
                             : vtkIrradianceFilter::PathTraced;
  inputs.NumberOfSpreadPhotons = (kind >> 5) % 2 == 0 ? 3 : 250;
  inputs.Seed = bytes.byte();
  inputs.NumberOfOutputWalks = inputs.Seed % 3 == 0 ? 0 : inputs.Seed;
  inputs.OutputWalksCell = inputs.Seed % 16 == 1 ? 0 : -1; // no such cell is an error
  inputs.Method = inputs.Seed % 4 == 3 ? vtkIrradianceFilter::Gathered
    : inputs.Seed % 8 == 2             ? vtkIrradianceFilter::Automatic
                                       : inputs.Method;
  inputs.TraversalMode = bytes.below(3);
  inputs.CacheStaticHits = bytes.below(2) == 0;
  inputs.SeparateSides = bytes.oneIn(4);
  inputs.DefaultDiffuseReflectance = bytes.oneIn(32) ? bytes.number() : bytes.below(8) / 8.0;
}

Inputs ReadInputs(ByteReader& bytes)
{
  Inputs inputs;
  ReadSettings(bytes, inputs);
  const int counts[2] = { bytes.byte(), bytes.byte() };
  const int connections[2] = { counts[0] % 3, counts[1] % 4 };
  inputs.View.HasEye = counts[0] / 3 % 2 != 0;
  inputs.View.HasSensors = counts[1] / 4 % 2 != 0;
  inputs.View.HasPoints = counts[0] / 6 % 2 != 0;
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < connections[port]; ++i)
    {
      inputs.Ports[port].push_back(FuzzedPolyData::Read(bytes));
    }
  }
  for (int i = 0; i < connections[1]; ++i)
  {
    inputs.Poses.emplace_back();
    if (bytes.oneIn(2))
    {
      vtkNew<vtkMatrix4x4> matrix;
      ReadPose(bytes, matrix);
      inputs.Poses.back() = vtkSmartPointer<vtkMatrixToLinearTransform>::New();
      inputs.Poses.back()->SetInput(matrix);
    }
  }
  if (inputs.View.HasEye || inputs.View.HasSensors)
  {
    FuzzedViews::Read(bytes, inputs.View);
  }
  return inputs;
}

void Apply(vtkIrradianceFilter* filter, const Inputs& inputs)
{
  filter->SetNumberOfWalks(inputs.NumberOfWalks);
  filter->SetSeed(inputs.Seed);
  filter->SetTraversalMode(inputs.TraversalMode);
  filter->SetCacheStaticHits(inputs.CacheStaticHits);
  filter->SetSeparateSides(inputs.SeparateSides);
  filter->SetDefaultDiffuseReflectance(inputs.DefaultDiffuseReflectance);
  filter->SetMethod(inputs.Method);
  filter->SetNumberOfRays(4);
  filter->SetNumberOfSpreadPhotons(inputs.NumberOfSpreadPhotons);
  filter->SetNumberOfOutputWalks(inputs.NumberOfOutputWalks);
  filter->SetOutputWalksPort(inputs.Seed % 2);
  filter->SetOutputWalksCell(inputs.OutputWalksCell);
}

vtkSmartPointer<vtkIrradianceFilter> MakeFuzzedFilter(const Inputs& inputs)
{
  auto filter = vtkSmartPointer<vtkIrradianceFilter>::New();
  Apply(filter, inputs);
  for (int port = 0; port < 2; ++port)
  {
    for (const Mesh& mesh : inputs.Ports[port])
    {
      filter->AddInputDataObject(port, mesh);
    }
  }
  for (std::size_t i = 0; i < inputs.Poses.size(); ++i)
  {
    filter->SetDynamicTransform(static_cast<int>(i), inputs.Poses[i]);
  }
  return filter;
}

/// Something changes, most often a pose.
void ChangeFrame(ByteReader& bytes, Inputs& inputs)
{
  const int kind = bytes.below(8);
  const int port = bytes.below(2);
  if (kind == 0)
  {
    ReadSettings(bytes, inputs);
  }
  else if (kind == 1 && !inputs.Ports[port].empty())
  {
    vtkPolyData* mesh = inputs.Ports[port][bytes.byte() % inputs.Ports[port].size()];
    if (mesh->GetNumberOfPoints() > 0)
    {
      const double x = bytes.number(), y = bytes.number();
      mesh->GetPoints()->SetPoint(bytes.byte() % mesh->GetNumberOfPoints(), x, y, bytes.number());
      mesh->GetPoints()->Modified();
      mesh->Modified();
    }
  }
  else if (kind == 2 && (inputs.View.HasEye || inputs.View.HasSensors))
  {
    FuzzedViews::Read(bytes, inputs.View);
  }
  else if (!inputs.Poses.empty())
  {
    const auto& pose = inputs.Poses[bytes.byte() % inputs.Poses.size()];
    if (pose)
    {
      ReadPose(bytes, pose->GetInput());
      pose->GetInput()->Modified();
    }
  }
}

void CheckIrradiance(vtkPolyData* block)
{
  for (const char* name : { "Irradiance", "IrradianceFront", "IrradianceBack" })
  {
    vtkDataArray* array = block->GetCellData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
    {
      const int components = array->GetNumberOfComponents();
      const double value = array->GetComponent(i / components, static_cast<int>(i % components));
      if (!(std::isfinite(value) && value >= 0))
      {
        Fail(std::string(name) + " " + std::to_string(i) + " is " + std::to_string(value));
      }
    }
  }
}

/// Whether the numbers, which have to be finite and balanced, are all dark.
bool CheckNumbers(vtkIrradianceFilter* filter)
{
  vtkMultiBlockDataSet* output = filter->GetOutput();
  for (unsigned int port = 0; port < 2; ++port)
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      CheckIrradiance(TestScenes::OutputOf(output, port, i));
    }
  }
  bool isDark = true;
  const int bands = output->GetFieldData()->GetArray("EmittedPower")->GetNumberOfComponents();
  for (int band = 0; band < bands; ++band)
  {
    const double emitted = TestScenes::Field(filter, "EmittedPower", band);
    const double absorbed = TestScenes::Field(filter, "AbsorbedPower", band);
    const double escaped = TestScenes::Field(filter, "EscapedPower", band);
    // Of gathered light either may be more than what is emitted; then the sum of two doubles loses
    // a bit.
    const double rounding =
      TestScenes::Field(filter, "DirectLight") == 1 ? 1e-15 * std::abs(escaped) : 0;
    if (!std::isfinite(emitted) || !(std::abs(emitted - (absorbed + escaped)) <= rounding))
    {
      Fail("emitted " + std::to_string(emitted) + ", absorbed " + std::to_string(absorbed) +
        ", escaped " + std::to_string(escaped));
    }
    isDark = isDark && emitted == 0;
  }
  return isDark;
}

/// They run from finite points to finite points, however far away those are.
void CheckWalks(vtkIrradianceFilter* filter)
{
  vtkPolyData* walks = filter->GetWalksOutput();
  for (vtkIdType i = 0; i < walks->GetNumberOfPoints(); ++i)
  {
    const double* point = walks->GetPoint(i);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      Fail("point " + std::to_string(i) + " of the walks is not finite");
    }
  }
}

/// One error and no output, or no error and a valid output.
void CheckUpdate(vtkIrradianceFilter* filter, const ErrorObserver* observer, const Inputs& inputs)
{
  if (observer->Errors.size() > 1)
  {
    Fail("two errors: " + observer->Errors[0] + observer->Errors[1]);
  }
  const bool hasOutput = filter->GetOutput()->GetNumberOfBlocks() > 0;
  const bool hasInput = !inputs.Ports[0].empty() || !inputs.Ports[1].empty();
  if (hasOutput != (observer->Errors.empty() && hasInput))
  {
    Fail(hasOutput ? "an output, and an error" : "no output, and no error");
  }
  if (hasOutput)
  {
    CheckNumbers(filter);
  }
  CheckWalks(filter);
  if (!hasOutput && filter->GetWalksOutput()->GetNumberOfPoints() > 0)
  {
    Fail("walks, but no other output");
  }
}

/// What looks at the photons sees the same as with a fresh filter.
void CompareViews(const Inputs& inputs, FuzzedViews::Filters& views, vtkIrradianceFilter* fresh)
{
  if (fresh->GetOutput()->GetNumberOfBlocks() == 0)
  {
    return;
  }
  FuzzedViews::Filters freshViews(fresh);
  views.Update(inputs.View);
  freshViews.Update(inputs.View);
  const auto isSame = IsSame(views, freshViews);
  if (!isSame)
  {
    Fail(std::string("views differ: ") + isSame.message());
  }
}

void Run(ByteReader bytes)
{
  Inputs inputs = ReadInputs(bytes);
  const auto filter = MakeFuzzedFilter(inputs);
  const auto observer = ErrorObserver::Watch(filter);
  FuzzedViews::Filters views(filter);
  for (int frame = 0; frame < 4; ++frame)
  {
    observer->Clear();
    filter->Modified(); // else VTK does not execute it again, and it reports nothing
    filter->Update();
    CheckUpdate(filter, observer, inputs);
    const auto fresh = MakeFuzzedFilter(inputs);
    const auto freshObserver = ErrorObserver::Watch(fresh);
    fresh->Update();
    // Updates do not repeat what was said before.
    if (fresh->GetOutput()->GetNumberOfBlocks() > 0 && CheckNumbers(fresh) &&
      freshObserver->Warnings.empty())
    {
      Fail("dark, and no warning");
    }
    if (observer->Errors.empty() != freshObserver->Errors.empty() ||
      !IsSame(OutputBits(filter), OutputBits(fresh)))
    {
      Fail("update and rebuild differ in frame " + std::to_string(frame) + ": " +
        IsSame(OutputBits(filter), OutputBits(fresh)).message());
    }
    const auto sameWalks = IsSame(ShownWalks::LastingBits(filter->GetWalksOutput()),
      ShownWalks::LastingBits(fresh->GetWalksOutput()));
    if (!sameWalks)
    {
      Fail("walks of update and rebuild differ in frame " + std::to_string(frame) + ": " +
        sameWalks.message());
    }
    CompareViews(inputs, views, fresh);
    if (bytes.isAtEnd())
    {
      return;
    }
    ChangeFrame(bytes, inputs);
    Apply(filter, inputs);
  }
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  // VTK's own messages about broken cells do not matter; events are sent nevertheless.
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  Run({ data, size });
  return 0;
}
