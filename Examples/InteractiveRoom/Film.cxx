// SPDX-License-Identifier: BSD-3-Clause
#include "Film.h"

#include "OutputFolder.h"
#include "VtkErrors.h"

#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>

namespace interactiveroom
{

Film::Film(const std::string& folder, vtkRenderWindow* window)
  : Folder(folder)
{
  movingteapot::PrepareFolder(folder, R"(InteractiveRoom\.(png|ogv))");
  this->Grabber->SetInput(window);
  this->Grabber->ReadFrontBufferOff();
  this->Grabber->ShouldRerenderOff();
  this->Movie->SetFileName((folder + "/InteractiveRoom.ogv").c_str());
  this->Movie->SetRate(30); // frames per second
  this->Movie->SetQuality(2);
  this->Movie->SetInputConnection(this->Grabber->GetOutputPort());
}

Film::~Film()
{
  if (this->IsStarted)
  {
    this->Movie->End();
  }
}

void Film::AddFrame()
{
  const movingteapot::VtkErrors errors;
  this->Grabber->Modified(); // the window has rendered again
  if (!this->IsStarted)
  {
    this->Movie->Start();
    this->IsStarted = true;
  }
  this->Movie->Write();
  errors.ThrowIfAny("--output: " + this->Folder + "/InteractiveRoom.ogv cannot be written");
}

void Film::WritePicture()
{
  const movingteapot::VtkErrors errors;
  this->Grabber->Modified();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(this->Grabber->GetOutputPort());
  writer->SetFileName((this->Folder + "/InteractiveRoom.png").c_str());
  writer->Write();
  errors.ThrowIfAny("--output: " + this->Folder + "/InteractiveRoom.png cannot be written");
}

}
