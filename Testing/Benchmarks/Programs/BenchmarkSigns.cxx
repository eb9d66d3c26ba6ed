// SPDX-License-Identifier: BSD-3-Clause
/**
 * How long vtkIrradianceFilter and vtkKeyFramedPose work without a sign: the longest CPU time of
 * the calling thread between two progress events, at which an abort would be noticed, where inputs,
 * results or changes are large. An observer that does nothing, one round each.
 */
#include "../../FiltersIrradiance/TestScenes.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"

#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkKeyFramedPose.h"
#include "vtkRegularPolygonSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace TestScenes;

namespace
{

/// A square of 1 m of resolution^2 cells, facing up; wavy in the middle so that it is no plane.
Mesh makeGround(int resolution)
{
  const Mesh ground = MakeRectangle({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, resolution);
  for (vtkIdType i = 0; i < ground->GetNumberOfPoints(); ++i)
  {
    double p[3];
    ground->GetPoint(i, p);
    ground->GetPoints()->SetPoint(i, p[0], p[1], 0.02 * std::sin(20 * p[0]) * std::sin(15 * p[1]));
  }
  return ground;
}

/// One polygon with a wavy rim.
Mesh makePolygon(int corners)
{
  vtkNew<vtkRegularPolygonSource> source;
  source->SetNumberOfSides(corners);
  source->GeneratePolylineOff();
  source->Update();
  Mesh polygon = source->GetOutput();
  for (vtkIdType i = 0; i < corners; ++i)
  {
    double p[3];
    polygon->GetPoint(i, p);
    const double radius = 0.8 + 0.1 * std::sin(40 * std::atan2(p[1], p[0]));
    polygon->GetPoints()->SetPoint(i, radius * p[0], radius * p[1], 0);
  }
  return polygon;
}

/// Updates a filter and reports how long it was silent.
class Listener
{
public:
  explicit Listener(vtkAlgorithm* filter)
    : filter_(filter)
  {
    filter->AddObserver(vtkCommand::ProgressEvent, this, &Listener::onSign);
  }

  void update(const std::string& what, const Goal& goal = {})
  {
    longest_ = 0;
    const double start = last_ = threadCpuSeconds();
    filter_->Update();
    onSign();
    const Goal promise{ 0.1, 0.05 };
    report("Signs", what, "longest without a sign, s", longest_, promise);
    report("Signs", what, "whole update, s", last_ - start, goal);
  }

private:
  void onSign()
  {
    longest_ = std::max(longest_, threadCpuSeconds() - last_);
    last_ = threadCpuSeconds();
  }

  vtkAlgorithm* filter_;
  double longest_ = 0, last_ = 0; ///< s
};

class Trial
{
public:
  Trial()
  {
    filter_->SetNumberOfWalks(10000);
    filter_->AddInputDataObject(0, MakeLamp({ 0, 0, 0.5 }, 0.4, { 100 }));
  }

  vtkIrradianceFilter* operator->() { return filter_; }
  void update(const std::string& what) { listener_.update(what); }

private:
  vtkNew<vtkIrradianceFilter> filter_;
  Listener listener_{ filter_ };
};

/// A spline through keys on a helix.
void measureKeys()
{
  constexpr int keys = 100000;
  vtkNew<vtkKeyFramedPose> pose;
  pose->SetInputData(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1));
  pose->SetInterpolationTypeToSpline();
  for (int key = 0; key < keys; ++key)
  {
    const double angle = 0.01 * key;
    pose->AddPose(key, std::cos(angle), std::sin(angle), angle, 0, 0, 10 * angle);
  }
  Listener(pose).update("100,000 keys of a spline are read", Goal{ 1, 0.5 });
  pose->UpdateTimeStep(5000);
  const double height =
    pose->GetOutput()->GetFieldData()->GetArray("ObjectToWorld")->GetComponent(0, 11);
  if (pose->GetOutputInformation(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) !=
      keys ||
    height != 0.01 * 5000)
  {
    throw std::runtime_error("the pose at a key differs from the key");
  }
}

}

void run(const Arguments& arguments)
{
  const int resolution = arguments.number(0, 1000);
  {
    const auto ground = makeGround(resolution);
    Trial trial;
    trial->AddInputDataObject(0, ground);
    trial.update("2 million static triangles are read");
    ground->Modified();
    trial.update("they are merely Modified()");
    trial->RemoveInputConnection(0, 1);
    trial.update("they go");
  }
  {
    vtkNew<vtkTransform> pose;
    Trial trial;
    trial->AddInputDataObject(1, makeGround(resolution));
    trial->SetDynamicTransform(0, pose);
    trial.update("2 million moving triangles are read");
    pose->Translate(0.01, 0, 0);
    trial.update("they move");
  }
  {
    Trial trial;
    trial->AddInputDataObject(0, makeGround(490));
    trial->ComputeStandardErrorOn();
    trial->SetNumberOfReplicates(256);
    trial.update("256 replicates, 240,000 cells");
    trial->SetSeed(2);
    trial.update("again with another seed");
  }
  {
    vtkNew<vtkTransform> pose;
    Trial trial;
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
    Trial trial;
    trial->AddInputDataObject(0, makePolygon(10000));
    trial.update("a polygon of 10,000 corners");
  }
  measureKeys();
}
