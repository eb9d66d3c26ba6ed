// SPDX-License-Identifier: BSD-3-Clause
// Lamp files that cannot be read, or are hardly meant: what is said of them.

#include "LuminaireFiles.h"

#include <clocale>

using namespace LuminaireFiles;

namespace
{

void ExpectError(const std::string& text, const std::vector<std::string>& words)
{
  SCOPED_TRACE(text.substr(0, 300));
  const auto reader = MakeReader(text);
  const Reports reports = Update(reader);
  ExpectOne(reports.Errors, words);
  EXPECT_TRUE(reports.Warnings.empty());
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
}

/// Two planes of two values: lines 1 to 9 are those of the standard.
std::string SmallIes(int line, const std::string& other, const std::string& version = "2002")
{
  const std::vector<std::string> lines{ "IESNA:LM-63-" + version, "[TEST] none", "TILT=NONE",
    "1 -1 1 2 2 1 2 0 0 0", "1 1 10", "0 90", "0 360", "7 8", "9 10" };
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    text += (static_cast<int>(i) + 1 == line ? other : lines[i]) + "\n";
  }
  return text;
}

/// With another line, counted from 1.
std::string ChangedLine(const std::string& text, int line, const std::string& other)
{
  std::istringstream stream(text);
  std::string result, content;
  for (int i = 1; std::getline(stream, content); ++i)
  {
    result += (i == line ? other : content) + "\n";
  }
  return result;
}

}

TEST(LuminaireErrors, OfIesNameLineAndValue)
{
  ExpectNothing(Update(MakeReader(SmallIes(0, ""))));
  ExpectError(SmallIes(9, "9 ten"), { "lamp.any, line 9", "candela value is \"ten\"" });
  ExpectError(SmallIes(9, "9 nan"), { "line 9", "\"nan\", which is no finite number" });
  ExpectError(SmallIes(9, "9 1e999"), { "line 9", "\"1e999\"" });
  ExpectError(SmallIes(8, "7 -8"), { "line 8", "candela value is -8", "negative" });
  ExpectError(SmallIes(9, "9"), { "line 9", "the file ends before the candela value" });
  ExpectError(SmallIes(9, "9 10 11"), { "line 9", "\"11\" follows", "2 x 2" });
  ExpectError(SmallIes(4, "1 -1 1,5 2 2 1 2 0 0 0"), { "line 4", "ballast factor is 0" });
  ExpectError(SmallIes(4, "1 -1 0 2 2 1 2 0 0 0"), { "line 4", "multiplier is 0", "above 0" });
  ExpectError(SmallIes(4, "1 -1 1 0 2 1 2 0 0 0"), { "line 4", "vertical angles is 0" });
  ExpectError(SmallIes(4, "1 -1 1 2 -2 1 2 0 0 0"), { "line 4", "horizontal angles is -2" });
  ExpectError(SmallIes(4, "1 -1 1 2 1e9 1 2 0 0 0"), { "line 4", "1 to 4000000 are possible" });
  ExpectError(SmallIes(4, "1 -1 1 2 2.5 1 2 0 0 0"), { "line 4", "2.5", "no whole number" });
  ExpectError(SmallIes(4, "1 -1 1 2 2 4 2 0 0 0"), { "line 4", "photometric type is 4" });
  ExpectError(SmallIes(4, "1 -1 1 2 2 1 3 0 0 0"), { "line 4", "type of units is 3" });
  ExpectError(SmallIes(5, "0 1 10"), { "line 5", "ballast factor is 0" });
  ExpectError(SmallIes(5, "1 0 10", "1991"), { "line 5", "ballast-lamp photometric factor is 0" });
  ExpectError(SmallIes(6, "90 0"), { "line 6", "vertical angle 0 follows 90" });
  ExpectError(SmallIes(6, "0 181"), { "line 6", "vertical angle is 181" });
  ExpectError(SmallIes(6, "-5 92", "1986"), { "line 6", "vertical angle is 92; -90 to 90" });
  ExpectError(SmallIes(6, "-5 90"), { "line 6", "vertical angle is -5" });
  ExpectError(SmallIes(7, "0 0"), { "line 7", "horizontal angle 0 follows 0" });
  ExpectError(SmallIes(7, "0 270"), { "line 7", "go from 0 to 270" });
  ExpectError(SmallIes(7, "45 360"), { "line 7", "go from 45 to 360" });
  ExpectError("IESNA91\nTILT=NONE\n1 -1 1 1 1 1 2 0 0 0\n1 1 1\n0\n0\n5\n", { "1 vertical" });
  ExpectError("IESNA91\nTILT=NONE\n1 -1 1 2 1 2 2 0 0 0\n1 1 1\n0 90\n0\n5 5\n", { "two and two" });
  ExpectError("IESNA91\nTILT=NONE\n1 -1 1 3000 3000 1 2 0 0 0\n1 1 1\n0\n", { "ends before" });
  ExpectError(ChangedLine(SmallIes(8, "0 0"), 9, "0 0"), { "lamp.any", "flux of the table is 0" });
}

TEST(LuminaireErrors, OfTiltNameTheFile)
{
  ExpectError(SmallIes(3, "TILT=none.tlt"), { "lamp.any, line 3", "none.tlt", "cannot be read" });
  ExpectError(SmallIes(3, "TILT="), { "line 3", "INCLUDE and the name of a file are possible" });
  WriteFile("here.tlt", "1\n2\n0 90\n1 -1\n");
  ExpectError(SmallIes(3, "TILT=here.tlt", "2019"), { "line 3", "here.tlt", "LM-63-2019" });
  ExpectError(SmallIes(3, "TILT=here.tlt"), { "here.tlt, line 4", "tilt factor is -1" });
  ExpectError(SmallIes(3, "TILT=INCLUDE\n4"), { "line 4", "geometry is 4" });
}

TEST(LuminaireErrors, OfEulumdatNameLineAndValue)
{
  Eulumdat file;
  const std::string text = file.Text();
  ExpectNothing(Update(MakeReader(text)));
  ExpectError(ChangedLine(text, 3, "5"), { "lamp.any, line 3", "EULUMDAT symmetry is 5" });
  ExpectError(ChangedLine(text, 3, "two"), { "line 3", "EULUMDAT symmetry is \"two\"" });
  ExpectError(ChangedLine(text, 4, "0"), { "line 4", "number of C planes is 0" });
  ExpectError(ChangedLine(text, 4, ""), { "line 4", "a number has to be here" });
  ExpectError(ChangedLine(text, 17, "-1"), { "line 17", "width of the luminous area is -1" });
  ExpectError(ChangedLine(text, 24, "0"), { "line 24", "conversion factor is 0" });
  ExpectError(ChangedLine(text, 29, "0"), { "line 29", "lumens of the lamps is 0" });
  ExpectError(ChangedLine(text, 44, "90"), { "line 45", "C angle 30 follows 90" });
  ExpectError(ChangedLine(text, 100, "-1"), { "line 100", "intensity is -1" });
  ExpectError(text.substr(0, text.size() - 20), { "the file ends before the intensity" });
  ExpectError(text + "12\n", { "\"12\" follows the table" });
  ExpectError(ChangedLine(text, 3, "2"), { "follows the table of 13 x 13" });
  file.Symmetry = 4;
  file.C = Steps(0, 300, 60);
  ExpectError(file.Text(), { "of the 6 C angles 2 are from 0 to 90", "symmetry 4" });
  ExpectError("no lamp\n", { "line 3", "a number has to be here", "begins with TILT=" });
}

TEST(LuminaireErrors, OfFilesAndProperties)
{
  vtkNew<vtkLuminaireReader> none;
  ExpectOne(Update(none).Errors, { "there is no FileName" });
  none->SetFileName("/nowhere/lamp.ies");
  ExpectOne(Update(none).Errors, { "/nowhere/lamp.ies", "cannot be read" });
  none->SetFileName(testing::TempDir().c_str());
  ExpectOne(Update(none).Errors, { "cannot be read" });
  ExpectError("", { "is empty or cannot be read" });
  ExpectError("\xFF\xFEI", { "UTF-16" });
  ExpectError(std::string("\0I\0E", 4), { "UTF-16" });
  const auto reader = MakeReader(SmallIes(0, ""));
  for (const auto& [efficacy, words] :
    std::vector<std::pair<double, std::string>>{
      { 0, "set LuminousEfficacy" }, { -1, "is -1" }, { 700, "is 700" }, { std::nan(""), "nan" } })
  {
    reader->SetLuminousEfficacy(efficacy);
    ExpectOne(Update(reader).Errors, { words });
  }
}

TEST(LuminaireErrors, WhatIsHardlyMeantIsAWarning)
{
  Eulumdat file;
  file.Symmetry = 1;
  file.Stored = { 0 };
  const double pi = vtkMath::Pi();
  const auto warnings = [&](double perCent, const std::string& ratio) {
    file.Value = [=](double, double) { return 10 * perCent / (4 * pi); };
    file.OutputRatio = ratio;
    const Reports reports = Update(MakeReader(file.Text()));
    EXPECT_TRUE(reports.Errors.empty());
    return reports.Warnings;
  };
  EXPECT_TRUE(warnings(78, "82").empty());
  EXPECT_TRUE(warnings(78, "").empty());
  ExpectOne(warnings(78, "84"), { "lamp.any", "78 %", "84 %" });
  ExpectOne(warnings(290, "100"), { "290", "100 %", "candela in place of cd/klm" });
  const std::string blocks = SmallIes(9, "9 10\n[ENDBLOCK]\n[BLOCK]\n") + SmallIes(0, "");
  ExpectOne(Update(MakeReader(blocks)).Warnings, { "several luminaires" });
}

TEST(LuminaireErrors, AreForgottenWithTheNextFile)
{
  const auto reader = MakeReader(SmallIes(9, "9"));
  EXPECT_EQ(Update(reader).Errors.size(), 1u);
  WriteFile("lamp.any", SmallIes(0, ""));
  reader->Modified();
  EXPECT_EQ(Read(reader)->GetNumberOfCells(), 1);
}

TEST(LuminaireErrors, NumbersAreReadAlikeInEveryLocale)
{
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  const double flux = Flux(Read(Ies().Text()));
  for (const char* const name : { "de_DE.UTF-8", "fr_FR.UTF-8" }) // where they are installed
  {
    std::setlocale(LC_NUMERIC, name);
    EXPECT_EQ(Flux(Read(Ies().Text())), flux);
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(LuminaireErrors, CanReadFileKnowsLampFiles)
{
  vtkNew<vtkLuminaireReader> reader;
  EXPECT_EQ(reader->CanReadFile(WriteFile("a", SmallIes(9, "broken")).c_str()), 1);
  EXPECT_EQ(reader->CanReadFile(WriteFile("b", Eulumdat().Text()).c_str()), 1);
  EXPECT_EQ(reader->CanReadFile(WriteFile("c", "x,y\n1,2\n").c_str()), 0);
  EXPECT_EQ(reader->CanReadFile("/nowhere/lamp.ies"), 0);
  EXPECT_EQ(reader->CanReadFile(nullptr), 0);
}
