// SPDX-License-Identifier: BSD-3-Clause
#ifndef Recording_h
#define Recording_h

#include "ParaViewSeries.h"
#include "Picture.h"

#include <vtkNew.h>

#include <memory>
#include <string>

class vtkMultiBlockDataSet;
class vtkOggTheoraWriter;

namespace movingteapot
{

struct RecordingConfig
{
  std::string Folder;
  bool Pictures = true;
  int Width = 1280, Height = 720; // pixels
  int SmoothingPasses = 2;
};

/**
 * What stays of a run, in one folder: MovingTeapot.pvd for ParaView and, with pictures, one PNG per
 * frame in pictures/ and the movie MovingTeapot.ogv. Throws std::runtime_error when something
 * cannot be written.
 */
class Recording
{
public:
  explicit Recording(const RecordingConfig& config);
  ~Recording();

  /** Frames come in order, from 0. `caption` goes into the picture. */
  void Add(int frame, double time, vtkMultiBlockDataSet* scene, const std::string& caption);

private:
  void AddPicture(int frame, vtkMultiBlockDataSet* scene, const std::string& caption);

  RecordingConfig Config;
  ParaViewSeries Series;
  std::unique_ptr<Picture> View; // null without pictures
  vtkNew<vtkOggTheoraWriter> Movie;
  bool MovieStarted = false;
};

}

#endif
