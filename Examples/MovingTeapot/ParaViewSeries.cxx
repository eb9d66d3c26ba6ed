// SPDX-License-Identifier: BSD-3-Clause
#include "ParaViewSeries.h"

#include "ErrorListener.h"
#include "FrameFile.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <fstream>
#include <stdexcept>

namespace movingteapot
{

ParaViewSeries::ParaViewSeries(const std::string& folder, const std::string& name)
  : Folder(folder)
  , Name(name)
{
  MakeFolder(folder + "/" + name);
}

void ParaViewSeries::Add(double time, vtkMultiBlockDataSet* scene)
{
  const std::string file = this->Name + "/" + FrameFile(this->Name, this->Times.size(), "vtm");
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  ErrorListener errors(writer);
  writer->SetFileName((this->Folder + "/" + file).c_str());
  writer->EncodeAppendedDataOff();
  writer->SetInputData(scene);
  const bool written = writer->Write() != 0;
  errors.ThrowIfAny(this->Folder + "/" + file + " cannot be written");
  if (!written)
  {
    throw std::runtime_error(this->Folder + "/" + file + " cannot be written");
  }
  this->Times.push_back(time);
  this->WriteList();
}

void ParaViewSeries::WriteList() const
{
  const std::string path = this->Folder + "/" + this->Name + ".pvd";
  std::ofstream list(path);
  list << "<?xml version=\"1.0\"?>\n"
       << "<VTKFile type=\"Collection\" version=\"0.1\">\n"
       << "  <Collection>\n";
  for (std::size_t i = 0; i < this->Times.size(); ++i)
  {
    list << "    <DataSet timestep=\"" << this->Times[i] << "\" part=\"0\" file=\"" << this->Name
         << "/" << FrameFile(this->Name, i, "vtm") << "\"/>\n";
  }
  list << "  </Collection>\n"
       << "</VTKFile>\n";
  list.flush();
  if (!list)
  {
    throw std::runtime_error(path + " cannot be written");
  }
}

}
