// Tests of CsvTable: columns by name, tolerance towards other programs' files, errors with their places.
#include "core/files/csv_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gaitlab::test {
namespace {

std::string error_of(const std::string& text, const char* column = "a") {
  try {
    static_cast<void>(CsvTable(text).column(column));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CsvTable, ReadsFilesOfOtherPrograms) {
  const CsvTable table("\xEF\xBB\xBF# bench 3\r\n t , a,\tnote \r\n0,1.5,started\r\n\r\n0.1,-2e-3,ok");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"t", "a", "note"}));
  EXPECT_EQ(table.column("t"), (std::vector<double>{0, 0.1}));
  EXPECT_EQ(table.column("a"), (std::vector<double>{1.5, -2e-3}));
}

TEST(CsvTable, ErrorsNameLineAndColumn) {
  EXPECT_EQ(error_of(""), "the table is empty; expected a line with the names of its columns");
  EXPECT_EQ(error_of("t,a\n0,1\n1\n"), "line 3, column 1: 1 cells; expected 2");
  EXPECT_EQ(error_of("t,a\n0, nan\n"), "line 2, column 4: 'nan' is not a finite number");
  EXPECT_EQ(error_of("t,a\n0,1;5\n"), "line 2, column 3: '1;5' is not a finite number");
  EXPECT_EQ(error_of("t;a\n0;1\n"), "line 1, column 2: expected cells between commas; found 't;a'");
  EXPECT_EQ(error_of("t,t\n"), "line 1, column 3: there is a column 't' already");
  EXPECT_EQ(error_of("t,,a\n"), "line 1, column 3: a column has no name");
  EXPECT_EQ(error_of("t,b\n0,1\n"), "there is no column 'a'; known columns: t, b");
}

TEST(CsvTable, ReadsEntriesOfJson) {
  const CsvTable table(
      "{\"mass\": 0.49, \"kp\": 100, \"entries\": [{\"position\": -0.1, \"torque_enable\": true, \"note\": \"x\", "
      "\"timestamp\": 0.0035},\n"
      "{\"position\": 2, \"torque_enable\": false, \"note\": null, \"timestamp\": 5e-1, \"temp\": 28}]}");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"position", "torque_enable", "note", "timestamp"}));
  EXPECT_EQ(table.column("position"), (std::vector<double>{-0.1, 2}));
  EXPECT_EQ(table.column("torque_enable"), (std::vector<double>{1, 0}));
  EXPECT_EQ(table.column("timestamp", 0.5), (std::vector<double>{0.007, 1}));
}

TEST(CsvTable, ErrorsNameEntryAndKey) {
  EXPECT_EQ(error_of(R"({"entries": [{"a": 1}, {"a": "open"}]})"), "entry 2, key 'a': 'open' is not a finite number");
  EXPECT_EQ(error_of(R"({"entries": [{"a": [1]}]})"), "entry 1, key 'a': '[1]' is not a finite number");
  EXPECT_EQ(error_of(R"({"entries": [{"a": 1}, {"b": 1}]})"), "entry 2: there is no key 'a'");
  EXPECT_EQ(error_of(R"({"entries": [{"a": 1}, 2]})"), "entry 2: there is no key 'a'");
  EXPECT_EQ(error_of(R"({"entries": [{"b": 1}]})"), "there is no column 'a'; known columns: b");
  EXPECT_EQ(error_of("{\"entries\":\n[{\"a\": 1}, {\"a\": NaN}]}"),
            "line 2, column 18: the text is not JSON from here on: it is cut or damaged");
  const std::string none = "the JSON has no entries; expected {\"entries\": [{\"timestamp\": 0, \"position\": 0.1}, ...]}";
  EXPECT_EQ(error_of("{}"), none);
  EXPECT_EQ(error_of(R"({"entries": []})"), none);
  EXPECT_EQ(error_of(R"({"entries": [1]})"), none);
  EXPECT_EQ(error_of(R"({"entries": [{"a": 1e999}]})"), "the JSON has a number beyond the range of a double");
}

}  // namespace
}  // namespace gaitlab::test
