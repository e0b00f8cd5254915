#include "studies/run/parcel.h"

#include <nlohmann/json.hpp>

namespace gaitlab::studies {

namespace {

using Json = nlohmann::json;

Json json_of(const Row& row) {
  Json json = Json::array({row.run, row.point, row.scenario, row.replicate, row.seed, row.outcome, row.message, row.simulated,
                           row.values, row.quantities, name_of(row.verdict), row.cause.check, row.cause.part, nullptr});
  if (row.score) json.back() = Json::array({row.score->objectives, row.score->violation});
  return json;
}

Row row_of(const Json& json) {
  Row row;
  std::size_t at = 0;
  const auto take = [&](auto& to) { json.at(at++).get_to(to); };
  take(row.run);
  take(row.point);
  take(row.scenario);
  take(row.replicate);
  take(row.seed);
  take(row.outcome);
  take(row.message);
  take(row.simulated);
  take(row.values);
  take(row.quantities);
  row.verdict = named<Word>(json.at(at++).get<std::string>()).value();
  take(row.cause.check);
  take(row.cause.part);
  if (const Json& score = json.at(at); !score.is_null()) {
    row.score.emplace();
    score.at(0).get_to(row.score->objectives);
    score.at(1).get_to(row.score->violation);
  }
  return row;
}

}  // namespace

Bytes packed(std::span<const Job> jobs) {
  Json all = Json::array();
  for (const Job& job : jobs) all.push_back(Json::array({json_of(job.row), job.sets, job.scenario, job.estimate, job.whole}));
  return Json::to_cbor(all);
}

Bytes packed(std::span<const Row> rows) {
  Json all = Json::array();
  for (const Row& row : rows) all.push_back(json_of(row));
  return Json::to_cbor(all);
}

std::vector<Job> jobs_of(const Bytes& bytes) {
  std::vector<Job> jobs;
  for (const Json& one : Json::from_cbor(bytes)) {
    jobs.push_back({row_of(one.at(0)), one.at(1).get<std::vector<std::string>>(), one.at(2).get<std::size_t>(),
                    one.at(3).get<bool>(), one.at(4).get<bool>()});
  }
  return jobs;
}

std::vector<Row> rows_of(const Bytes& bytes) {
  std::vector<Row> rows;
  for (const Json& one : Json::from_cbor(bytes)) rows.push_back(row_of(one));
  return rows;
}

}  // namespace gaitlab::studies
