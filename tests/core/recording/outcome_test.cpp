#include "core/recording/outcome.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.h"
#include "core/recording/recording_file.h"
#include "tests/core/recording/tables.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

TEST(Outcomes, TextIsTheMessageOrTheName) {
  EXPECT_EQ(Outcome().text(), "done");
  EXPECT_TRUE(Outcome().done());
  EXPECT_EQ(Outcome{Ended::not_run}.text(), "not run");
  EXPECT_EQ((Outcome{Ended::plugin, "stopped at step 3: no luck"}.text()), "stopped at step 3: no luck");
  EXPECT_TRUE(Outcome::of("done").done());
  const Outcome early = Outcome::of("diverged at step 3");
  EXPECT_EQ(early.ended, Ended::early) << "a text is shown, not read";
  EXPECT_EQ(early.text(), "diverged at step 3");
}

class StoredOutcomes : public testing::Test {
 protected:
  StoredTrace written(const Outcome& outcome, const std::string& format = "h5") const {
    Recording made;
    made.trace = {{{"t", "s", ""}}, {0, 1}};
    made.outcome = outcome;
    write_recording(made, {"", 0, "", outcome.text()}, format, own_.path());
    return read_h5(own_.path() / (format == "h5" ? "trace.h5" : kBesideCsv));
  }
  [[nodiscard]] Outcome read() const { return read_recording(own_.path()).recording.outcome; }
  /// Outcome of a recording that is written again with the value `ended`.
  [[nodiscard]] Outcome read_with(const StoredTrace& stored, double ended) const {
    std::vector<Beside> beside = stored.beside;
    Trace& run = std::ranges::find(beside, "run", &Beside::name)->table;
    run.values[run.find("ended")] = ended;
    write_h5(stored.trace, stored.origin, own_.path() / "trace.h5", tables_of(beside));
    return read();
  }

  const test::Folder own_;
};

TEST_F(StoredOutcomes, AreReadBack) {
  for (const auto& [ended, text] : EnumNames<Ended>::kTable) {
    const Outcome outcome{ended, ended == Ended::done ? "" : "because"};
    written(outcome);
    EXPECT_EQ(read().ended, ended) << text;
    EXPECT_EQ(read().text(), outcome.text());
  }
}

TEST_F(StoredOutcomes, AreReadBackBesideCsv) {
  written({Ended::interrupted, "interrupted at t = 1 s"}, "csv");
  EXPECT_EQ(read().ended, Ended::interrupted);
  EXPECT_EQ(read().message, "interrupted at t = 1 s");
}

TEST_F(StoredOutcomes, ThatContradictTheirTextAreRefused) {
  const StoredTrace stored = written({});
  const std::string corrupt = (own_.path() / "trace.h5").string() + ": error: is corrupt: ";
  for (const auto& [ended, what] :
       {std::pair{1.0, "outcome is done, but ended is diverged"}, {7.0, "ended is 7"}, {-1.0, "ended is -1"}}) {
    EXPECT_EQ(test::message_of([&, number = ended] { (void)read_with(stored, number); }), corrupt + what);
  }
}

}  // namespace
}  // namespace gaitlab
