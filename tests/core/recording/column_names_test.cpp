// Tests of texts in which columns and numbers have the names of joints.
#include "core/recording/column_names.h"

#include <gtest/gtest.h>

namespace gaitlab::test {
namespace {

TEST(ColumnNames, NameTheJoint) {
  const PartNames names{{"m0/active", "", "m1/active"}, {"m0/active/p0"}};
  EXPECT_EQ(readable_column("joint.0.torque", names), "m0/active torque");
  EXPECT_EQ(readable_column("joint.2.voltage_command", names), "m1/active voltage command");
  EXPECT_EQ(readable_column("contact.0.fn", names), "m0/active/p0 fn");
  EXPECT_EQ(readable_column("torque_error.2", names), "m1/active torque error");
}

TEST(ColumnNames, KeepWhatIsOfNoKnownPart) {
  const PartNames names{{"m0/active", "", "m1/active"}, {}};
  for (const char* column : {"t", "base.x", "base.qw", "joint.1.torque", "joint.3.torque", "joint.x.torque", "joint.0",
                             "joint.", "joint.99999999999999999999999.torque", "contact.0.fn", "cpg.0.x", "load.0", ""})
    EXPECT_EQ(readable_column(column, names), column);
}

TEST(ColumnNames, OfNumbers) {
  EXPECT_EQ(readable_number("m7/passive.torque.rms"), "m7/passive torque RMS");
  EXPECT_EQ(readable_number("m7/passive.torque.peak"), "m7/passive torque peak");
  EXPECT_EQ(readable_number("cost_of_transport.electrical"), "cost_of_transport.electrical");
  EXPECT_EQ(readable_number("distance"), "distance");
}

}  // namespace
}  // namespace gaitlab::test
