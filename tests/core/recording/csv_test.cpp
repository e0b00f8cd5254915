#include "core/recording/csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <random>

#include "core/errors.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

class Csv : public testing::Test {
 protected:
  void put(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }
  [[nodiscard]] std::string text() const { return test::read(file_); }
  // Message of the error on reading `text`, as `LINE:COL: error: ...`.
  [[nodiscard]] std::string complaint(const std::string& text) const {
    put(text);
    const std::string message = test::message_of([&] { read_csv(file_); });
    return message == test::kNoError ? message : message.substr(file_.string().size() + 1);
  }

  const test::Folder own_;
  const fs::path folder_ = own_.path(), file_ = folder_ / "trace.csv";
};

TEST_F(Csv, IsOneHeaderRowAndShortestNumbers) {
  write_csv({{{"t", "s", ""}, {"base.x", "m", ""}}, {0, 0.1, 0.005, -1e-7, 1, 1.0 / 3}}, file_);
  EXPECT_EQ(text(), "t,base.x\n0,0.1\n0.005,-1e-07\n1,0.3333333333333333\n");
}

TEST_F(Csv, ReadsBackEveryBit) {
  Trace trace{{{"t", "", ""}, {"a", "", ""}, {"b", "", ""}}, {}};
  std::mt19937_64 random(1);
  while (trace.values.size() < 30000) {
    const double value = std::bit_cast<double>(random());
    if (value == value) trace.values.push_back(value);
  }
  using limits = std::numeric_limits<double>;
  trace.values.insert(trace.values.end(), {-0.0, limits::denorm_min(), limits::max(), limits::min(), -limits::infinity(), 0.1});
  write_csv(trace, file_);
  const Trace back = read_csv(file_);
  ASSERT_EQ(back.columns.size(), 3U);
  EXPECT_EQ(back.columns[1].name, "a");
  ASSERT_EQ(back.values.size(), trace.values.size());
  EXPECT_EQ(std::memcmp(back.values.data(), trace.values.data(), sizeof(double) * trace.values.size()), 0);
  EXPECT_EQ(hash(back), hash(trace));
}

TEST_F(Csv, AcceptsNanAndInfinity) {
  write_csv({{{"a", "", ""}}, {std::numeric_limits<double>::quiet_NaN(), 1}}, file_);
  const Trace back = read_csv(file_);
  ASSERT_EQ(back.rows(), 2U);
  EXPECT_NE(back.values[0], back.values[0]);
  put("a,b\ninf,-inf\n");
  EXPECT_EQ(read_csv(file_).at(0, 1), -std::numeric_limits<double>::infinity());
}

TEST_F(Csv, QuotesNamesThatNeedIt) {
  const Trace trace{{{"a,b", "", ""}, {"say \"x\"", "", ""}, {"\"", "", ""}}, {1, 2, 3}};
  write_csv(trace, file_);
  EXPECT_EQ(text(), "\"a,b\",\"say \"\"x\"\"\",\"\"\"\"\n1,2,3\n");
  EXPECT_EQ(hash(read_csv(file_)), hash(trace));
  EXPECT_THROW(write_csv({{{"a\nb", "", ""}}, {1}}, file_), RunError);
  EXPECT_THROW(write_csv({{{"", "", ""}}, {1}}, file_), RunError);
}

// Number format with a decimal comma and grouped thousands, independent of the installed locales.
class Comma : public std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST_F(Csv, DoesNotCareForTheLocale) {
  const std::string of_c = std::setlocale(LC_ALL, nullptr);
  (void)std::setlocale(LC_ALL, "de_DE.UTF-8");  // locale of C functions, if it is installed
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  std::ostringstream felt;
  felt << 1234.5;
  write_csv({{{"a", "", ""}}, {1234.5}}, file_);
  const double back = read_csv(file_).values[0];
  std::locale::global(before);
  std::setlocale(LC_ALL, of_c.c_str());
  EXPECT_EQ(felt.str(), "1.234,5");
  EXPECT_EQ(text(), "a\n1234.5\n");
  EXPECT_EQ(back, 1234.5);
}

TEST_F(Csv, HeaderAloneIsATraceWithoutRows) {
  put("t,a\n");
  EXPECT_EQ(read_csv(file_).rows(), 0U);
  EXPECT_EQ(read_csv(file_).columns.size(), 2U);
}

TEST_F(Csv, AcceptsLineEndsOfAnotherSystem) {
  put("t,a\r\n0,1\r\n");
  EXPECT_EQ(read_csv(file_).columns[1].name, "a");
  EXPECT_EQ(read_csv(file_).at(0, 1), 1);
}

TEST_F(Csv, SaysWhereAndWhat) {
  EXPECT_EQ(complaint(""), "1:1: error: the file is empty: a header row of column names is missing");
  EXPECT_EQ(complaint("0,1\n0.1,2\n"), "1:1: error: the header row of column names is missing");
  EXPECT_EQ(complaint("1,1\n"), "1:1: error: the header row of column names is missing");
  EXPECT_EQ(complaint("t,a,t\n0,1,2\n"), "1:5: error: column \"t\" is there twice");
  EXPECT_EQ(complaint("1,1,a\n"), "1:3: error: column \"1\" is there twice");
  EXPECT_EQ(complaint("t,,a\n"), "1:3: error: empty column name");
  EXPECT_EQ(complaint("t,\n"), "1:3: error: empty column name");
  EXPECT_EQ(complaint("\n0\n"), "1:1: error: empty column name");
  EXPECT_EQ(complaint("t,\"a\n0,1\n"), "1:3: error: the quoted column name has no closing quote");
  EXPECT_EQ(complaint("t,\"a\"b\n"), "1:6: error: expected a comma after the quoted column name");
  EXPECT_EQ(complaint("t,a\n0,1\n0.1\n"), "3:4: error: 1 cells, expected 2");
  EXPECT_EQ(complaint("t,a\n0,1,2\n"), "2:5: error: more than 2 cells");
  EXPECT_EQ(complaint("t,a\n0,1\n\n"), "3:1: error: \"\" is not a number");
  EXPECT_EQ(complaint("t,a\n0,\n"), "2:3: error: \"\" is not a number");
  EXPECT_EQ(complaint("t,a\n0,1.5x\n"), "2:3: error: \"1.5x\" is not a number");
  EXPECT_EQ(complaint("t,a\n0, 1\n"), "2:3: error: \" 1\" is not a number");
  EXPECT_EQ(complaint("t,a\n0,\"1\"\n"), "2:3: error: \"\"1\"\" is not a number");
  EXPECT_EQ(complaint("t,a\n0,1e400\n"), "2:3: error: 1e400 is outside the range of a double");
  EXPECT_EQ(complaint("t,a\n0,1\n0.1,1.2"), "3:8: error: the last line has no line end: the file is truncated");
}

TEST_F(Csv, SaysThatAFileCannotBeRead) {
  EXPECT_EQ(test::message_of([&] { read_csv(folder_ / "absent.csv"); }),
            (folder_ / "absent.csv").string() + ": error: cannot be read: No such file or directory");
  EXPECT_THROW(read_csv(folder_), InputError);
}

}  // namespace
}  // namespace gaitlab
