#include "studies/run/asked.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/study/number.h"

namespace gaitlab::studies {

Asked::Asked(Plan& plan, Journal& journal) : plan_(plan), journal_(journal) {
  const std::uint64_t runs = plan.points().runs_of_point();
  journal.each_row({"run", "point"}, [&](const std::vector<std::string>& row) {
    const auto run = static_cast<std::uint64_t>(std::stoull(row[0]));
    Known& known = in_journal_[run / runs];
    known.name = row[1];
    known.run = run;
    if (++known.rows == runs) numbers_.try_emplace(row[1], run / runs);
  });
}

std::uint64_t Asked::point(std::vector<std::string> values) {
  const std::string name = plan_.point_name(values);
  if (const auto at = numbers_.find(name); at != numbers_.end()) {
    if (at->second == next_) pass_taken();
    return at->second;
  }
  for (auto taken = in_journal_.find(next_); taken != in_journal_.end(); taken = in_journal_.find(next_)) {
    const bool same = taken->second.name == name;
    pass_taken();
    if (same) return next_ - 1;
  }
  if (next_ >= plan_.points().points())
    throw InputError(SourceLocation{"stdin"}, fmt::format("asks for more than {} points", plan_.points().points()));
  plan_.add(std::move(values));
  numbers_[name] = next_;
  return next_++;
}

/// Takes the point next_ from the journal, even if it lacks replicates, and advances to the next number.
void Asked::pass_taken() {
  const Known& known = in_journal_.at(next_);
  const std::vector<std::string> names = journal_.columns().all();
  const std::vector<std::string> row = journal_.row(known.run);
  std::vector<std::string> values;
  for (std::size_t k = 0; k < plan_.study().parameters.size(); ++k) {
    const auto at = std::ranges::find(names, journal_.columns().parameters[k]);
    values.push_back(row[static_cast<std::size_t>(at - names.begin())]);
  }
  plan_.add(std::move(values));
  numbers_.try_emplace(known.name, next_);
  ++next_;
}

}  // namespace gaitlab::studies
