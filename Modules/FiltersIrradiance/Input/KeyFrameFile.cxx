// SPDX-License-Identifier: BSD-3-Clause
#include "Input/KeyFrameFile.h"

#include "Input/Pose.h"
#include "Progress/InputError.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

namespace irradiance
{

namespace
{

using Cells = std::vector<std::string>;

/// Without the blanks and the quotes around it.
std::string trimmed(const std::string& cell)
{
  constexpr const char* kAround = " \t\r\"";
  const std::size_t first = cell.find_first_not_of(kAround);
  return first == std::string::npos
    ? std::string()
    : cell.substr(first, cell.find_last_not_of(kAround) - first + 1);
}

Cells cellsOf(const std::string& line)
{
  Cells cells;
  std::size_t begin = 0;
  for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1)
  {
    comma = line.find(',', begin);
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
  }
  return cells;
}

/// The lines of a table, one after the other.
class Table
{
public:
  explicit Table(const std::string& fileName)
    : fileName_(fileName)
    , stream_(fileName)
  {
    throwIf(!stream_, "the file " + fileName + " cannot be read");
    std::error_code unknown; // such as the length of a pipe
    length_ = std::filesystem::file_size(fileName, unknown);
    length_ = unknown ? 0 : length_;
    throwIf(!next(), "the file " + fileName + " is empty; its first line has to name the columns");
    for (std::size_t i = 0; i < cells_.size(); ++i)
    {
      std::string& name = cells_[i];
      constexpr const char* kMark = "\xef\xbb\xbf"; // with which some programs begin text
      name = name.rfind(kMark, 0) == 0 ? trimmed(name.substr(3)) : name;
      throwIf(!columns_.emplace(name, i).second, where() + ": two columns are named " + name);
    }
    header_ = where();
  }

  bool next()
  {
    std::string line, content;
    do
    {
      if (!std::getline(stream_, line))
      {
        throwIf(stream_.bad(), "the file " + fileName_ + " cannot be read");
        return false;
      }
      ++line_;
      read_ += line.size() + 1;
      content = trimmed(line);
    } while (content.empty() || content.front() == '#');
    cells_ = cellsOf(line);
    return true;
  }

  /// What was read of the file, 0..1; 0 if its length is not known.
  double progress() const
  {
    return read_ < length_ ? static_cast<double>(read_) / static_cast<double>(length_)
                           : (length_ > 0 ? 1.0 : 0.0);
  }
  std::string where() const { return "line " + std::to_string(line_) + " of " + fileName_; }
  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  bool hasAny(const std::vector<std::string>& columns) const
  {
    return std::any_of(
      columns.begin(), columns.end(), [this](const std::string& column) { return has(column); });
  }
  /// Throws InputError if one is not there.
  void require(const std::vector<std::string>& columns) const
  {
    for (const std::string& column : columns)
    {
      throwIf(!has(column), header_ + ": there is no column " + column);
    }
  }

  double value(const std::string& column) const
  {
    const std::size_t i = columns_.at(column);
    if (i >= cells_.size())
    {
      throw InputError(where() + " has " + std::to_string(cells_.size()) +
        " values and none in the column " + column);
    }
    const std::string& cell = cells_[i];
    const char* begin = cell.data() + (!cell.empty() && cell.front() == '+' ? 1 : 0);
    const char* end = cell.data() + cell.size();
    double number = 0;
    const auto read = std::from_chars(begin, end, number); // the same in every locale
    if (read.ec != std::errc() || read.ptr != end)
    {
      throw InputError(where() + ", column " + column + ": \"" + cell + "\" is not a number");
    }
    if (!std::isfinite(number))
    {
      throw InputError(where() + ", column " + column + ": " + cell + " is not finite");
    }
    return number;
  }
  Vector3 values(const std::array<const char*, 3>& columns) const
  {
    return { value(columns[0]), value(columns[1]), value(columns[2]) };
  }

private:
  std::string fileName_;
  std::ifstream stream_;
  std::uintmax_t read_ = 0, length_ = 0; ///< bytes
  std::size_t line_ = 0;
  std::string header_;
  Cells cells_;
  std::map<std::string, std::size_t> columns_;
};

std::string matrixColumn(int row, int column)
{
  return "m" + std::to_string(row) + std::to_string(column);
}

AffineMap readMatrix(const Table& table)
{
  double matrix[16] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
  for (int i = 0; i < 16; ++i)
  {
    const std::string column = matrixColumn(i / 4, i % 4);
    matrix[i] = i < 12 || table.has(column) ? table.value(column) : matrix[i];
  }
  return poseOf(table.where(), matrix);
}

AffineMap readQuaternion(const Table& table)
{
  const Eigen::Quaterniond rotation(
    table.value("qw"), table.value("qx"), table.value("qy"), table.value("qz"));
  const double norm = rotation.norm();
  if (!(norm > 0))
  {
    throw InputError(table.where() + ": the quaternion is 0");
  }
  return { Eigen::Quaterniond(rotation.coeffs() / norm).toRotationMatrix(),
    table.values({ "x", "y", "z" }) };
}

AffineMap readDegrees(const Table& table)
{
  const Vector3 place = table.values({ "x", "y", "z" }), turns = table.values({ "rx", "ry", "rz" });
  return poseOf(table.where(), propMatrix(place.data(), turns.data()).data());
}

AffineMap readPosition(const Table& table)
{
  return { Matrix3::Identity(), table.values({ "x", "y", "z" }) };
}

using ReadPose = AffineMap (*)(const Table&);

/// How the columns of the table tell a pose.
ReadPose readerFor(const Table& table)
{
  const std::vector<std::string> place{ "x", "y", "z" }, degrees{ "rx", "ry", "rz" },
    quaternion{ "qw", "qx", "qy", "qz" };
  std::vector<std::string> matrix(12);
  for (int i = 0; i < 12; ++i)
  {
    matrix[static_cast<std::size_t>(i)] = matrixColumn(i / 4, i % 4);
  }
  table.require({ "time" });
  const bool hasDegrees = table.hasAny(degrees), hasQuaternion = table.hasAny(quaternion);
  if (table.hasAny(matrix))
  {
    throwIf(table.hasAny(place) || hasDegrees || hasQuaternion,
      table.where() +
        ": there are columns of a matrix and others of a position or a rotation; "
        "which are meant?");
    table.require(matrix);
    return readMatrix;
  }
  table.require(place);
  throwIf(hasDegrees && hasQuaternion,
    table.where() + ": there are columns of angles and of a quaternion; which are meant?");
  table.require(hasDegrees ? degrees : hasQuaternion ? quaternion : place);
  return hasDegrees ? readDegrees : hasQuaternion ? readQuaternion : readPosition;
}

}

std::vector<KeyFrame> readKeyFrames(
  const std::string& fileName, const std::function<void(double)>& report)
{
  Table table(fileName);
  const ReadPose readPose = readerFor(table);
  const CancelPoint cancelPoint = [&] { report(table.progress()); };
  ThrottledCancelPoint pace(cancelPoint);
  std::vector<KeyFrame> keys;
  while (table.next())
  {
    pace.step();
    keys.push_back({ table.where(), table.value("time"), readPose(table) });
  }
  return keys;
}

}
