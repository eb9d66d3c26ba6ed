#include "TextWrap.h"

#include <algorithm>
#include <sstream>

std::string wrapped(const std::string& paragraph)
{
  constexpr std::size_t kWidth = 97; // a unit may follow
  const std::size_t text = std::min(paragraph.find_first_not_of(' '), paragraph.size());
  const std::string indent(text, ' ');
  const std::string hanging = indent + (paragraph.compare(text, 2, "* ") == 0 ? "  " : "");
  std::istringstream words(paragraph);
  std::string all, line = indent;
  for (std::string word; words >> word;)
  {
    const bool isFirst = line.find_first_not_of(' ') == std::string::npos;
    if (!isFirst && word[0] != '%' && line.size() + 1 + word.size() > kWidth)
    {
      all += line + '\n';
      line = hanging + word;
    }
    else
    {
      line += (isFirst ? "" : " ") + word;
    }
  }
  return all + line + '\n';
}
