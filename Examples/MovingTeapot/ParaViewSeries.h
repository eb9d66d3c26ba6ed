// SPDX-License-Identifier: BSD-3-Clause
#ifndef ParaViewSeries_h
#define ParaViewSeries_h

#include <string>
#include <vector>

class vtkMultiBlockDataSet;

namespace movingteapot
{

/**
 * A time series for ParaView: folder/name.pvd, which lists folder/name/name_0000.vtm and so on.
 * Whatever is there after any frame can be opened.
 */
class ParaViewSeries
{
public:
  /** The folder must exist. */
  ParaViewSeries(const std::string& folder, const std::string& name);

  /** Throws std::runtime_error when the files cannot be written. */
  void Add(double time, vtkMultiBlockDataSet* scene);

private:
  void WriteList() const;

  std::string Folder;
  std::string Name;
  std::vector<double> Times;
};

}

#endif
