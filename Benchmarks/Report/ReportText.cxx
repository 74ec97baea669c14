// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReportText.h"

#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace meniscus::report
{

//------------------------------------------------------------------------------
std::string Quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
      result += c;
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", c);
      result += code;
    }
    else
    {
      result += c;
    }
  }
  return result + "\"";
}

//------------------------------------------------------------------------------
std::string FormatNumber(double value, int digits)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

//------------------------------------------------------------------------------
void ReportText::AddMember(const std::string& name, const std::string& value)
{
  this->Members += (this->Members.empty() ? "" : ",\n") + Quoted(name) + ": " + value;
}

//------------------------------------------------------------------------------
void ReportText::LeaveOut(const std::string& what, const std::string& reason)
{
  this->LeftOut.emplace_back(what, reason);
}

//------------------------------------------------------------------------------
void ReportText::Miss(const std::string& what, const std::string& reason)
{
  this->Missing.emplace_back(what, reason);
}

//------------------------------------------------------------------------------
std::string ReportText::ListOf(const Entries& entries)
{
  std::string text;
  for (const auto& entry : entries)
  {
    text += "- " + entry.first + ": " + entry.second + "\n";
  }
  return text.empty() ? "Nothing.\n" : text;
}

//------------------------------------------------------------------------------
std::string ReportText::JsonOf(const Entries& entries)
{
  std::string text;
  for (const auto& entry : entries)
  {
    text += (text.empty() ? "" : ", ") +
      ("{\"name\": " + Quoted(entry.first) + ", \"reason\": " + Quoted(entry.second) + "}");
  }
  return "[" + text + "]";
}

//------------------------------------------------------------------------------
bool ReportText::WriteFiles(const std::string& folder) const
{
  std::ofstream page(folder + "/report.md");
  page << this->Page << "\n## Left out\n\n"
       << ListOf(this->LeftOut) << "\n## Missing\n\n"
       << ListOf(this->Missing);
  std::ofstream json(folder + "/report.json");
  json << "{\n"
       << this->Members << ",\n\"left_out\": " << JsonOf(this->LeftOut)
       << ",\n\"missing\": " << JsonOf(this->Missing)
       << ",\n\"failed_tests\": " << this->FailedTests
       << ",\n\"complete\": " << (this->IsComplete() ? "true" : "false") << "\n}\n";
  page.flush();
  json.flush();
  return page.good() && json.good();
}

} // namespace meniscus::report
