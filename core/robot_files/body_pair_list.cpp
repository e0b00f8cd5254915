#include "core/robot_files/body_pair_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/model/pattern.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {

namespace {

/// Bodies that a name or pattern matches. Adds a problem if there are none.
std::vector<std::string> matching(const Node& node, const std::vector<std::string>& bodies, const std::string& owner,
                                  Problems& problems) {
  const Reading<std::string> text = read_scalar(node);
  if (!text.ok()) {
    problems.add(node.place, fmt::format("a body of {} {}", kMayOverlap, text.wrong));
    return {};
  }
  std::vector<std::string> found;
  for (const std::string& body : bodies) {
    if (glob(text.value, body)) found.push_back(body);
  }
  if (!found.empty()) return found;
  const char* const how = is_pattern(text.value) ? "body matches" : "body";
  problems.add(node.place, fmt::format("{}: no {} {} in {}", kMayOverlap, how, in_quotes(text.value), clipped(owner)) +
                               offer(text.value, bodies, "bodies"));
  return {};
}

}  // namespace

std::vector<BodyPair> read_body_pairs(const Node& list, const std::vector<std::string>& bodies, const std::string& owner,
                                      Problems& problems) {
  std::vector<BodyPair> pairs;
  if (list.kind != Node::Kind::list) {
    problems.add(list.place, fmt::format("{} is {}; expected a list of pairs [[BODY, BODY], ...]", kMayOverlap, found(list)));
    return pairs;
  }
  for (const Node& pair : list.items) {
    if (pair.kind != Node::Kind::list || pair.items.size() != 2) {
      const std::string what = pair.kind == Node::Kind::list ? fmt::format("a list of {}", pair.items.size()) : found(pair);
      problems.add(pair.place, fmt::format("an entry of {} is {}; expected a pair [BODY, BODY]", kMayOverlap, what));
      continue;
    }
    const std::array<std::vector<std::string>, 2> two{matching(pair.items[0], bodies, owner, problems),
                                                      matching(pair.items[1], bodies, owner, problems)};
    if (two[0].empty() || two[1].empty()) continue;
    if (two[0] == two[1] && two[0].size() == 1) {
      problems.add(pair.place, fmt::format("an entry of {} has only {}; expected two bodies", kMayOverlap, two[0].front()));
      continue;
    }
    pairs.push_back({pair.items[0].text, pair.items[1].text});
  }
  return pairs;
}

Node body_pairs_node(const std::vector<BodyPair>& pairs) {
  Node list{Node::Kind::list};
  for (const BodyPair& pair : pairs) {
    Node row{Node::Kind::list};
    row.flow = true;
    row.items = {text_node(pair.first), text_node(pair.second)};
    list.items.push_back(std::move(row));
  }
  return list;
}

}  // namespace gaitlab
