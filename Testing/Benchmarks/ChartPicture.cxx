#include "ChartPicture.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <stdexcept>

namespace
{

void styleAxes(vtkChartXY* chart)
{
  for (const int place : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis* axis = chart->GetAxis(place);
    axis->GetLabelProperties()->SetFontSize(16);
    axis->GetTitleProperties()->SetFontSize(16);
    axis->GetTitleProperties()->BoldOff();
  }
}

void placeLegend(vtkChartXY* chart)
{
  chart->SetShowLegend(true);
  vtkChartLegend* legend = chart->GetLegend();
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetLabelSize(15);
}

}

void writePicture(vtkChartXY* chart, const std::string& path)
{
  styleAxes(chart);
  placeLegend(chart);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(1200, 520);
  window->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grabber->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw std::runtime_error(path + ": cannot be written");
  }
}
