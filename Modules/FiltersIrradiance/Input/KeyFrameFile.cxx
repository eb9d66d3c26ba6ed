// SPDX-License-Identifier: BSD-3-Clause
#include "Input/KeyFrameFile.h"

#include "Input/CommaTable.h"
#include "Input/Pose.h"

#include <array>

namespace irradiance
{

namespace
{

Vector3 values(const CommaTable& table, const std::array<const char*, 3>& columns)
{
  return { table.value(columns[0]), table.value(columns[1]), table.value(columns[2]) };
}

std::string matrixColumn(int row, int column)
{
  return "m" + std::to_string(row) + std::to_string(column);
}

AffineMap readMatrix(const CommaTable& table)
{
  double matrix[16] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
  for (int i = 0; i < 16; ++i)
  {
    const std::string column = matrixColumn(i / 4, i % 4);
    matrix[i] = i < 12 || table.has(column) ? table.value(column) : matrix[i];
  }
  return poseOf(table.where(), matrix);
}

AffineMap readQuaternion(const CommaTable& table)
{
  const Eigen::Quaterniond rotation(
    table.value("qw"), table.value("qx"), table.value("qy"), table.value("qz"));
  const double norm = rotation.norm();
  table.failIf(!(norm > 0), ": the quaternion is 0");
  return { Eigen::Quaterniond(rotation.coeffs() / norm).toRotationMatrix(),
    values(table, { "x", "y", "z" }) };
}

AffineMap readDegrees(const CommaTable& table)
{
  const Vector3 place = values(table, { "x", "y", "z" }),
                turns = values(table, { "rx", "ry", "rz" });
  return poseOf(table.where(), propMatrix(place.data(), turns.data()).data());
}

AffineMap readPosition(const CommaTable& table)
{
  return { Matrix3::Identity(), values(table, { "x", "y", "z" }) };
}

using ReadPose = AffineMap (*)(const CommaTable&);

/// How the columns of the table tell a pose.
ReadPose readerFor(const CommaTable& table)
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
    table.failIf(table.hasAny(place) || hasDegrees || hasQuaternion,
      ": there are columns of a matrix and others of a position or a rotation; which are meant?");
    table.require(matrix);
    return readMatrix;
  }
  table.require(place);
  table.failIf(hasDegrees && hasQuaternion,
    ": there are columns of angles and of a quaternion; which are meant?");
  table.require(hasDegrees ? degrees : hasQuaternion ? quaternion : place);
  return hasDegrees ? readDegrees : hasQuaternion ? readQuaternion : readPosition;
}

}

std::vector<KeyFrame> readKeyFrames(
  const std::string& fileName, const std::function<void(double)>& report)
{
  CommaTable table(fileName);
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
