// The tables of a journal: SQLite makes each of them under its name, and refuses rows of other kinds.
#include "studies/journal/journal_tables.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "studies/journal/database.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab::studies {
namespace {

class JournalTables : public testing::Test {
 protected:
  JournalTables() {
    for (const JournalTable& table : kTables) database_.execute(table.sql);
  }
  const test::Folder folder_;
  Database database_{folder_ / "study.db", Database::Mode::write};
};

TEST_F(JournalTables, AreMadeUnderTheirNames) {
  Statement tables = database_.prepare("SELECT name, sql FROM sqlite_schema WHERE type = 'table' ORDER BY rowid");
  std::set<std::string> names;
  for (const JournalTable& table : kTables) {
    ASSERT_TRUE(tables.step()) << table.name;
    EXPECT_EQ(tables.text(0), table.name);
    EXPECT_EQ(tables.text(1), table.sql) << "a journal whose text differs is refused";
    EXPECT_NE(std::string(table.name), "run") << "its columns depend on the study";
    names.insert(table.name);
  }
  EXPECT_FALSE(tables.step());
  EXPECT_EQ(names.size(), kTables.size());
}

/// `gait` in ASCII, by which file(1) and others know the file.
TEST_F(JournalTables, HaveTheIdOfTheProgram) {
  EXPECT_EQ(kApplication, ('g' << 24) + ('a' << 16) + ('i' << 8) + 't');
  EXPECT_GT(kSchema, 0);
}

TEST_F(JournalTables, HaveOneRowPerNumber) {
  const auto twice = [&](const std::string& insert) {
    database_.execute(insert);
    return test::message_of<std::exception>([&] { database_.execute(insert); });
  };
  for (const char* insert :
       {"INSERT INTO attempt VALUES(7, 1)", "INSERT INTO search VALUES(0, 3, 0, 0, 8, 8, 2, NULL, NULL, 0.5)",
        "INSERT INTO verification VALUES(0, 7, 'half step', '', 1, NULL, NULL, 0, 'feasible', 1, '', '')",
        "INSERT INTO effort VALUES(0, 0, 8, '2026-01-31T23:59:59Z', 0.5, 'host', 12)"})
    EXPECT_NE(twice(insert).find("UNIQUE constraint failed"), std::string::npos) << insert << ": " << twice(insert);
  database_.execute("INSERT INTO search VALUES(1, 3, 0, 0, 8, 8, 2, NULL, NULL, 0.5)");
  EXPECT_EQ(database_.integer("SELECT count(*) FROM search"), 2) << "another search in the same generation";
}

/// The head is strict: a text in a column of numbers is refused, as nothing else would notice it.
TEST_F(JournalTables, HaveAStrictHead) {
  const auto head = [&](const std::string& seed, const std::string& quantile) {
    return test::message_of<std::exception>([&] {
      database_.execute("INSERT INTO study VALUES('n', 'now', 'b', 'd', 's', 'c', " + seed + ", 8, 1, 'worst', " + quantile +
                        ", 1, 'grid', 0, 0.05, '')");
    });
  };
  EXPECT_EQ(head("1", "0.5"), test::kNoError);
  EXPECT_NE(head("'one'", "0.5"), test::kNoError);
  EXPECT_NE(head("1", "'half'"), test::kNoError);
  EXPECT_NE(head("NULL", "0.5"), test::kNoError);
}

}  // namespace
}  // namespace gaitlab::studies
