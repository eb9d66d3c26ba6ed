// SPDX-License-Identifier: BSD-3-Clause
#include "Recording.h"

#include "ErrorListener.h"
#include "FrameFile.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>

#include <algorithm>

namespace movingteapot
{
namespace
{

constexpr const char* Name = "MovingTeapot";
constexpr int FramesPerSecond = 15;

void WritePng(vtkImageData* image, const std::string& path)
{
  vtkNew<vtkPNGWriter> writer;
  ErrorListener errors(writer);
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
  errors.ThrowIfAny(path + " cannot be written");
}

}

Recording::Recording(const RecordingConfig& config)
  : Config(config)
  , Series(config.Folder, Name)
{
  if (config.Pictures)
  {
    MakeFolder(config.Folder + "/pictures");
    this->View = std::make_unique<Picture>(config.Width, config.Height, config.SmoothingPasses);
    this->Movie->SetFileName((config.Folder + "/" + Name + ".ogv").c_str());
    this->Movie->SetRate(FramesPerSecond);
    this->Movie->SetQuality(2);
  }
}

Recording::~Recording()
{
  if (this->MovieStarted)
  {
    this->Movie->End();
  }
}

void Recording::Add(int frame, double time, vtkMultiBlockDataSet* scene, const std::string& caption)
{
  this->Series.Add(time, scene);
  if (this->View)
  {
    this->AddPicture(frame, scene, caption);
  }
}

void Recording::AddPicture(int frame, vtkMultiBlockDataSet* scene, const std::string& caption)
{
  auto image = this->View->Draw(scene, caption);
  WritePng(image, this->Config.Folder + "/pictures/" + FrameFile(Name, frame, "png"));

  ErrorListener errors(this->Movie);
  this->Movie->SetInputData(image);
  if (!this->MovieStarted)
  {
    this->Movie->Start();
    this->MovieStarted = true;
  }
  this->Movie->Write();
  errors.ThrowIfAny(std::string(this->Movie->GetFileName()) + " cannot be written");
}

}
