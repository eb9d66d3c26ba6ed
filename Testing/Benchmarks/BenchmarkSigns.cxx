/**
 * How long vtkIrradianceFilter works without a sign: the longest CPU time of the calling thread between
 * two progress events, at which an abort would be noticed, where inputs, results or changes are large.
 * An observer that does nothing, one round each.
 */
#include "Program.h"
#include "Results.h"
#include "Timing.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkIrradianceFilter.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

class SignWatch : public vtkCommand
{
public:
  static SignWatch* New() { return new SignWatch; }

  void Execute(vtkObject*, unsigned long, void*) override
  {
    this->Longest = std::max(this->Longest, threadCpuSeconds() - this->Last);
    this->Last = threadCpuSeconds();
  }

  double Longest = 0, Last = 0; ///< s
};

/// A square of 1 m of resolution^2 cells, facing up; wavy in the middle so that it is no plane.
vtkSmartPointer<vtkPolyData> makeGround(int resolution)
{
  vtkNew<vtkPlaneSource> source;
  source->SetResolution(resolution, resolution);
  source->Update();
  auto ground = vtkSmartPointer<vtkPolyData>::New();
  ground->DeepCopy(source->GetOutput());
  for (vtkIdType i = 0; i < ground->GetNumberOfPoints(); ++i)
  {
    double p[3];
    ground->GetPoint(i, p);
    ground->GetPoints()->SetPoint(i, p[0], p[1], 0.02 * std::sin(20 * p[0]) * std::sin(15 * p[1]));
  }
  return ground;
}

vtkSmartPointer<vtkPolyData> makeLamp()
{
  vtkNew<vtkPlaneSource> source; // facing down
  source->SetOrigin(-0.2, -0.2, 0.5);
  source->SetPoint1(-0.2, 0.2, 0.5);
  source->SetPoint2(0.2, -0.2, 0.5);
  source->Update();
  auto lamp = vtkSmartPointer<vtkPolyData>::New();
  lamp->DeepCopy(source->GetOutput());
  vtkNew<vtkDoubleArray> exitance;
  exitance->SetName("RadiantExitance");
  exitance->InsertNextValue(100);
  lamp->GetCellData()->AddArray(exitance);
  return lamp;
}

/// One polygon with a wavy rim.
vtkSmartPointer<vtkPolyData> makePolygon(vtkIdType corners)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(corners));
  for (vtkIdType i = 0; i < corners; ++i)
  {
    const double angle =
      2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = 0.4 + 0.05 * std::sin(40 * angle);
    cells->InsertCellPoint(
      points->InsertNextPoint(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  auto polygon = vtkSmartPointer<vtkPolyData>::New();
  polygon->SetPoints(points);
  polygon->SetPolys(cells);
  return polygon;
}

class Trial
{
public:
  explicit Trial(Results& results)
    : results_(results)
  {
    filter_->SetNumberOfWalks(10000);
    filter_->AddObserver(vtkCommand::ProgressEvent, watch_);
    filter_->AddInputDataObject(0, makeLamp());
  }

  vtkIrradianceFilter* operator->() { return filter_; }

  void update(const std::string& what)
  {
    watch_->Longest = 0;
    const double start = watch_->Last = threadCpuSeconds();
    filter_->Update();
    watch_->Execute(nullptr, 0, nullptr);
    constexpr double kPromise = 0.1, kAim = 0.05;
    results_.add(
      "Signs", what, "longest without a sign, s", { watch_->Longest }, { kPromise, kAim });
    results_.add("Signs", what, "whole update, s", { threadCpuSeconds() - start });
  }

private:
  Results& results_;
  vtkNew<vtkIrradianceFilter> filter_;
  vtkNew<SignWatch> watch_;
};

void run(int argc, char* argv[])
{
  const int resolution = argc > 1 ? std::atoi(argv[1]) : 1000;
  Results results("BenchmarkSigns");
  {
    const auto ground = makeGround(resolution);
    Trial trial(results);
    trial->AddInputDataObject(0, ground);
    trial.update("2 million static triangles are read");
    ground->Modified();
    trial.update("they are merely Modified()");
    trial->RemoveInputConnection(0, 1);
    trial.update("they go");
  }
  {
    vtkNew<vtkTransform> pose;
    Trial trial(results);
    trial->AddInputDataObject(1, makeGround(resolution));
    trial->SetDynamicTransform(0, pose);
    trial.update("2 million moving triangles are read");
    pose->Translate(0.01, 0, 0);
    trial.update("they move");
  }
  {
    Trial trial(results);
    trial->AddInputDataObject(0, makeGround(490));
    trial->ComputeStandardErrorOn();
    trial->SetNumberOfReplicates(256);
    trial.update("256 replicates, 240,000 cells");
    trial->SetSeed(2);
    trial.update("again with another seed");
  }
  {
    vtkNew<vtkTransform> pose;
    Trial trial(results);
    trial->AddInputDataObject(0, makeGround(30));
    trial->AddInputDataObject(1, makeGround(2));
    trial->SetDynamicTransform(0, pose);
    trial->SetMaximumNumberOfWalks(4000000);
    trial->SetNumberOfWalks(1000000);
    trial->SetTargetRelativeError(1e-6);
    trial.update("4 million walks are shot");
    trial->SetTargetRelativeError(1);
    trial.update("3 million of them are dropped");
    trial->SetSeed(2);
    trial.update("all are dropped for a new seed");
  }
  {
    Trial trial(results);
    trial->AddInputDataObject(0, makePolygon(10000));
    trial.update("a polygon of 10,000 corners");
  }
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
