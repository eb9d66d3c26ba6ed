// SPDX-License-Identifier: BSD-3-Clause
/**
 * Bidirectional path tracing over the scene and the trees of the engine: a picture that gets better
 * pass by pass, and the paper's comparison of three ways to search two trees (section 2.5). See
 * README.md in this folder.
 */
#include "BidirectionalTracer.h"
#include "Film.h"
#include "Options.h"
#include "OutputFolder.h"
#include "ReadScene.h"
#include "RoomScene.h"

#include "Pipeline/FilterRun.h"

#include <vtkImageData.h>
#include <vtkSMPTools.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>

using namespace irradiance;
using namespace pathtracedroom;

namespace
{

class Clock
{
public:
  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

// Root mean square of the standard errors of all pixels over the mean radiance.
double RelativeError(const Estimates& pixels)
{
  double squares = 0, sum = 0;
  for (std::size_t bin = 0; bin < pixels.numberOfBins(); ++bin)
  {
    squares += pixels.standardError(bin).square().mean();
    sum += pixels.mean(bin).mean();
  }
  const auto bins = double(pixels.numberOfBins());
  return std::sqrt(squares / bins) / (sum / bins);
}

void Write(const Estimates& pixels, int bands, const RoomScene& scene, const Options& options)
{
  const auto image = MakeImage(pixels, options.Width, options.Height, bands);
  WritePicture(image, scene.Exposure, options.Output + "/PathTracedRoom.png");
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName((options.Output + "/PathTracedRoom.vti").c_str());
  writer->Write();
}

// The picture is written after 1, 2, 4, ... passes and after the last, so that one can watch it.
void Render(const SceneObjects& objects, const RoomScene& scene, const Options& options)
{
  const CameraRays camera = MakeCameraRays(scene.Camera, options.Width, options.Height);
  BidirectionalTracer::Config config;
  config.traversal = options.Traversal;
  const BidirectionalTracer tracer(objects, camera, config);
  SmpExecution execution([](double) { return true; });
  Estimates pixels(camera.numberOfBins());
  const Clock clock;
  for (int pass = 1; pass <= options.Samples; ++pass)
  {
    pixels.add(tracer.trace(std::uint64_t(pass), 1, execution));
    const bool isPowerOfTwo = (pass & (pass - 1)) == 0;
    if (isPowerOfTwo || pass == options.Samples)
    {
      Write(pixels, objects.staticObject.material->bands, scene, options);
      std::printf("%5d samples a pixel, %7.1f s", pass, clock.Seconds());
      pass > 1 ? std::printf(", error %.1f %%\n", 100 * RelativeError(pixels)) : std::printf("\n");
      std::fflush(stdout);
    }
  }
}

SceneObjects Flattened(SceneObjects objects)
{
  for (SceneObject& object : objects.dynamicObjects)
  {
    object.isFlattened = true;
  }
  return objects;
}

struct Timing
{
  double Seconds;
  std::vector<Spectrum> Pixels;
};

// The least of several rounds, which other programs on the machine disturb least. Trees are built
// before.
std::vector<Timing> TimeTraversals(const SceneObjects& objects, const Sensor& camera, int rounds)
{
  SmpExecution execution([](double) { return true; });
  std::vector<BidirectionalTracer> tracers;
  for (const Options::TraversalName& traversal : Options::Traversals)
  {
    BidirectionalTracer::Config config;
    config.traversal = traversal.Mode;
    tracers.emplace_back(objects, camera, config);
  }
  std::vector<Timing> timings(tracers.size(), { 1e300, {} });
  for (int round = 0; round < rounds; ++round)
  {
    for (std::size_t i = 0; i < tracers.size(); ++i)
    {
      const Clock clock;
      timings[i].Pixels = tracers[i].trace(1, 1, execution);
      timings[i].Seconds = std::min(timings[i].Seconds, clock.Seconds());
    }
  }
  return timings;
}

bool HaveSameBits(const std::vector<Timing>& timings)
{
  return std::all_of(timings.begin(), timings.end(), [&](const Timing& timing) {
    return std::memcmp(timing.Pixels.data(), timings[0].Pixels.data(),
             timing.Pixels.size() * sizeof(Spectrum)) == 0;
  });
}

// Section 2.5 of the paper. There, each dynamic triangle may move on its own; here, also as
// objects.
bool CompareTraversals(const SceneObjects& objects, const RoomScene& scene, const Options& options)
{
  const CameraRays camera = MakeCameraRays(scene.Camera, options.Width, options.Height);
  const std::vector<Timing> whole = TimeTraversals(objects, camera, options.Rounds);
  const std::vector<Timing> single = TimeTraversals(Flattened(objects), camera, options.Rounds);
  std::printf("Seconds for a sample of each pixel, the least of %d\n", options.Rounds);
  std::printf("%-12s %18s %18s\n", "", "moving objects", "moving triangles");
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    std::printf("%-12s %10.3f %6.0f %% %9.3f %6.0f %%\n", Options::Traversals[i].Name,
      whole[i].Seconds, 100 * whole[i].Seconds / whole[0].Seconds, single[i].Seconds,
      100 * single[i].Seconds / single[0].Seconds);
  }
  const bool same = HaveSameBits(whole) && HaveSameBits(single);
  std::printf("All pictures have %s bits.\n", same ? "the same" : "DIFFERENT");
  return same;
}

int Run(const Options& options)
{
  vtkSMPTools::Initialize(options.Threads);
  RoomScene scene;
  MakeRoomScene(options.Scene, options.Segments, scene);
  const SceneObjects objects = ReadScene(scene.Light);
  if (options.CompareTraversals)
  {
    return CompareTraversals(objects, scene, options) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  movingteapot::PrepareFolder(options.Output, R"(PathTracedRoom\.(png|vti))");
  Render(objects, scene, options);
  std::printf("Written to %s: PathTracedRoom.png, PathTracedRoom.vti\n", options.Output.c_str());
  return EXIT_SUCCESS;
}

}

int main(int argc, char* argv[])
{
  try
  {
    const Options options = ReadOptions({ argv + 1, argv + argc });
    if (options.Help)
    {
      std::cout << HelpText();
      return EXIT_SUCCESS;
    }
    return Run(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << "PathTracedRoom: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
