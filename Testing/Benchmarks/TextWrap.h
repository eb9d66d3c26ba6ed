#ifndef TextWrap_h
#define TextWrap_h

#include <string>

/// The words of a paragraph in lines of at most 100 characters, as far as words allow; each ends with
/// a line break. No line begins with %. The first line is indented as it was, those of a list's item
/// behind its mark.
std::string wrapped(const std::string& paragraph);

#endif
