#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

std::string unknown_loads(const Scenario& scenario, const Recording& record) {
  if (const ContactModel& contact = scenario.contact.model(); !contact.element_forces) {
    return fmt::format("not available with contact.law: {}, which yields impulses that do not all act at contact elements",
                       contact.text);
  }
  if (record.loads.rows() < 2)
    return "loads were not recorded: `gaitlab run`, `test` and `swap` record them, unless a run ends at once";
  return "";
}

std::string unknown_of_feet(const CheckedRun& run) {
  if (run.scenario.base != Base::floating || !run.scenario.ground.exists())
    return "judged only for a floating base on a ground";
  return unknown_loads(run.scenario, run.record);
}

bool walks(double way, Check& made) {
  constexpr double kLeastWay = 0.01;  // m, least distance for a share of slip or creep
  made.text = fmt::format("the robot goes only {}: less than {} does not count as walking", texts::length(way),
                          texts::length(kLeastWay));
  return way >= kLeastWay;
}

}  // namespace gaitlab::report
