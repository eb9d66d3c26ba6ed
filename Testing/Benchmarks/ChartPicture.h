#ifndef ChartPicture_h
#define ChartPicture_h

#include <string>

class vtkChartXY;

/// Gives a chart the common look and writes it to a PNG file. Throws std::runtime_error when it cannot
/// be written.
void writePicture(vtkChartXY* chart, const std::string& path);

#endif
