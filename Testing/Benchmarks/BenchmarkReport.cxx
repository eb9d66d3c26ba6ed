/**
 * Fills a template with the results of the other programs here. These lines of the template are
 * replaced:
 *
 *   {{machine}}                 the machine, the versions, the date
 *   {{table NAME}}              the table of the benchmark NAME
 *   {{chart NAME: TITLE}}       its picture with bars, with the title of the axis of values
 *   {{lines NAME: X | Y}}       its picture with lines, quantity Y over quantity X; "log" before a
 *                               quantity asks for a logarithmic axis
 *   {{further results}}         the tables of all benchmarks that are not named before
 *
 * and this within a line, whose paragraph is wrapped anew:
 *
 *   {{value NAME | ROW | QUANTITY}}   the median
 *
 * Arguments: TEMPLATE REPORT PICTURES RESULTS.csv... (PICTURES: a folder beside the report)
 */
#include "BarChart.h"
#include "LineChart.h"
#include "Machine.h"
#include "ResultFile.h"
#include "ResultTable.h"
#include "TextWrap.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace
{

class Report
{
public:
  Report(std::ostream& stream, std::string pictures, std::vector<Result> results)
    : stream_(stream)
    , pictures_(std::move(pictures))
    , results_(std::move(results))
  {
  }

  void writeLine(const std::string& line)
  {
    static const std::regex placeholder(R"(\{\{(\w+) ?([^:}]*)(?:: ([^}]*))?\}\})");
    std::smatch match;
    const bool isText =
      line.find("{{value ") != std::string::npos || !std::regex_match(line, match, placeholder);
    if (line.empty() || !isText || line.find("* ") < line.find_first_not_of(" *"))
    {
      finishParagraph();
    }
    if (line.empty())
    {
      stream_ << '\n';
    }
    else if (isText)
    {
      paragraph_ += line + '\n';
    }
    else if (match[1] == "machine")
    {
      stream_ << describeMachine();
    }
    else if (match[1] == "table")
    {
      writeTableOf(match[2]);
    }
    else if (match[1] == "chart")
    {
      writeChartOf(match[2], match[3]);
    }
    else if (match[1] == "lines")
    {
      writeLinesOf(match[2], match[3]);
    }
    else if (match[1] == "further")
    {
      writeFurther();
    }
    else
    {
      throw std::runtime_error("unknown placeholder: " + line);
    }
  }

  /// The text that waits for its end: as it stands, or with its figures in lines of their own length.
  void finishParagraph()
  {
    static const std::regex form(R"(\{\{value\s+(\w+)\s+\|\s+([^|]*)\s\|\s+([^}]*)\}\})");
    bool hasFigures = false;
    for (std::smatch match; std::regex_search(paragraph_, match, form); hasFigures = true)
    {
      paragraph_ =
        match.prefix().str() + valueOf(match[1], match[2], match[3]) + match.suffix().str();
    }
    stream_ << (hasFigures ? wrapped(paragraph_) : paragraph_);
    paragraph_.clear();
  }

private:
  std::vector<Result> resultsOf(const std::string& benchmark) const
  {
    std::vector<Result> chosen;
    std::copy_if(results_.begin(), results_.end(), std::back_inserter(chosen),
      [&](const Result& result) { return result.benchmark == benchmark; });
    return chosen;
  }

  void writeTableOf(const std::string& benchmark)
  {
    named_.insert(benchmark);
    const std::vector<Result> results = resultsOf(benchmark);
    results.empty() ? void(stream_ << "(Not measured in this run.)\n")
                    : writeTable(stream_, results);
  }

  void writeChartOf(const std::string& benchmark, const std::string& title)
  {
    const std::vector<Result> results = resultsOf(benchmark);
    if (!results.empty())
    {
      const std::string file = pictures_ + '/' + benchmark + ".png";
      writeBarChart(file, title, results);
      writePictureLink(benchmark, title);
    }
  }

  void writeLinesOf(const std::string& benchmark, const std::string& axes)
  {
    static const std::regex form(R"((log )?(.*) \| (log )?(.*))");
    std::smatch match;
    if (!std::regex_match(axes, match, form))
    {
      throw std::runtime_error("axes of " + benchmark + ": " + axes);
    }
    const std::vector<Result> results = resultsOf(benchmark);
    if (!results.empty())
    {
      writeLineChart(pictures_ + '/' + benchmark + ".png", { match[2], match[1].matched },
        { match[4], match[3].matched }, results);
      writePictureLink(benchmark, match.str(4) + " over " + match.str(2));
    }
  }

  void writePictureLink(const std::string& benchmark, const std::string& title)
  {
    stream_ << "![" << title << "](" << vtksys::SystemTools::GetFilenameName(pictures_) << '/'
            << benchmark << ".png)\n";
  }

  std::string valueOf(
    const std::string& benchmark, const std::string& row, const std::string& quantity) const
  {
    for (const Result& result : resultsOf(benchmark))
    {
      if (result.row == row && result.quantity == quantity)
      {
        return shortNumber(result.spread.median);
      }
    }
    throw std::runtime_error("no result " + benchmark + " | " + row + " | " + quantity);
  }

  void writeFurther()
  {
    for (const std::string& benchmark : distinct(results_, &Result::benchmark))
    {
      if (named_.count(benchmark) == 0)
      {
        stream_ << "\n## " << benchmark << "\n\n";
        writeTableOf(benchmark);
      }
    }
  }

  std::ostream& stream_;
  std::string pictures_;
  std::vector<Result> results_;
  std::string paragraph_;
  std::set<std::string> named_; ///< benchmarks whose table is written
};

void run(const std::vector<std::string>& arguments)
{
  if (arguments.size() < 4)
  {
    throw std::runtime_error("usage: BenchmarkReport TEMPLATE REPORT PICTURES RESULTS.csv...");
  }
  std::vector<Result> results;
  for (auto path = arguments.begin() + 3; path != arguments.end(); ++path)
  {
    const std::vector<Result> own = readResults(*path);
    results.insert(results.end(), own.begin(), own.end());
  }
  std::ifstream text(arguments[0]);
  std::ostringstream stream; // the old report stays if something fails
  Report report(stream, arguments[2], results);
  for (std::string line; std::getline(text, line);)
  {
    report.writeLine(line);
  }
  report.finishParagraph();
  std::ofstream file(arguments[1]);
  file << stream.str();
  if (!text.eof() || !file.flush())
  {
    throw std::runtime_error(arguments[0] + " cannot be read or " + arguments[1] + " written");
  }
}

}

int main(int argc, char* argv[])
{
  try
  {
    run({ argv + 1, argv + argc });
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
