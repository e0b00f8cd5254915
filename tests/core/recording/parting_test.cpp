// Results of the additional rollouts of a run, which its folder contains: they are read as written, and invalid results are
// refused.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.h"
#include "core/recording/recording_file.h"
#include "tests/core/recording/tables.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

struct StoredPartings : testing::Test {
  StoredPartings() {
    made.trace = {{{"t", "s", ""}}, {0, 1}};
    made.joints.resize(2);
    made.tally.torque_error.assign(2, 0.0);
    made.tally.torque_peak.assign(2, 1.0);
    made.tally.event = {0.25, 1, 0.03};
    made.tally.chaotic = {-1, 0, 1e-9};
    made.tally.ill = {0.5, 0, 0.125};
  }
  [[nodiscard]] Recording read() const {
    write_recording(made, {"", 0, "", "done"}, "h5", own.path());
    return read_recording(own.path()).recording;
  }
  Recording made;
  test::Folder own;
};

TEST_F(StoredPartings, AreReadBack) {
  made.spread = {{{"distance", "m", "travel"}, {"margin.heat", "", "margin"}}, {0.1, 0.5, 0.2, -0.5}};
  const Recording there = read();
  for (const auto member : {&StepTally::event, &StepTally::chaotic, &StepTally::ill}) {
    EXPECT_EQ((there.tally.*member).time, (made.tally.*member).time);
    EXPECT_EQ((there.tally.*member).joint, (made.tally.*member).joint);
    EXPECT_EQ((there.tally.*member).share, (made.tally.*member).share);
  }
  EXPECT_EQ(there.spread.values, made.spread.values);
  ASSERT_EQ(there.spread.columns.size(), 2U);
  EXPECT_EQ(there.spread.columns[1].name, "margin.heat");
}

TEST_F(StoredPartings, NameAJointThatThereIs) {
  made.tally.ill.joint = 2;
  const std::string text = test::message_of([&] { (void)read(); });
  EXPECT_NE(text.find("is corrupt: parting.ill.joint is 2"), std::string::npos) << text;
}

}  // namespace
}  // namespace gaitlab
