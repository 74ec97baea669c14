// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** The report's text and figures while they are collected. */
#pragma once

#include <string>
#include <vector>

namespace meniscus::report
{

/** A text as a JSON string. */
std::string Quoted(const std::string& text);

/** A number with digits after the point. */
std::string FormatNumber(double value, int digits);

class ReportText
{
public:
  /** Appends to the Markdown page. */
  void Write(const std::string& text) { this->Page += text; }

  /** Adds a member of the JSON object; `value` is JSON. */
  void AddMember(const std::string& name, const std::string& value);

  /** Records something that the run does not contain on purpose, with the reason. */
  void LeaveOut(const std::string& what, const std::string& reason);

  /** Records something that should have been measured and is missing. */
  void Miss(const std::string& what, const std::string& reason);

  void CountFailedTests(int count) { this->FailedTests += count; }
  int GetFailedTests() const { return this->FailedTests; }
  bool IsComplete() const { return this->Missing.empty(); }

  /** Writes report.md and report.json into a folder; returns false if that fails. */
  bool WriteFiles(const std::string& folder) const;

private:
  using Entries = std::vector<std::pair<std::string, std::string>>;
  static std::string ListOf(const Entries& entries);
  static std::string JsonOf(const Entries& entries);

  std::string Page;
  std::string Members;
  Entries LeftOut;
  Entries Missing;
  int FailedTests = 0;
};

} // namespace meniscus::report
