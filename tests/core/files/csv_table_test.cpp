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
  EXPECT_EQ(error_of("t,b\n0,1\n"), "there is no column 'a'");
}

}  // namespace
}  // namespace gaitlab::test
