#include "interchange/srdf.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "interchange/xml_tags.h"
#include "interchange/xml_text.h"

namespace gaitlab::interchange {

std::vector<BodyPair> srdf_pairs(const std::string& file, const std::string& urdf,
                                 const std::map<std::string, std::string>& body_of_link, Problems& problems) {
  const std::string whole = read_text(file);
  check_xml(whole, file);
  const std::string text = without_comments(whole);
  const std::vector<XmlTag> tags = xml_tags(text);
  if (tags.empty() || tags.front().name != "robot")
    throw InputError(SourceLocation{file}, "is not SRDF; expected an element <robot>");
  std::vector<std::string> links;
  for (const auto& [link, body] : body_of_link) links.push_back(link);
  std::set<std::array<std::string, 2>> seen;
  std::vector<BodyPair> pairs;
  for (const XmlTag& tag : tags) {
    if (tag.name != "disable_collisions") continue;
    std::array<std::string, 2> pair;
    for (std::size_t i = 0; i < pair.size(); ++i) {
      const std::string key = "link" + std::to_string(i + 1);
      const XmlTag::Attribute* const link = tag.attribute(key);
      if (link == nullptr) {
        problems.add(place_in_text(text, tag.begin, file), "disable_collisions has no " + key);
        continue;
      }
      const std::string name = decoded(std::string(link->value));
      const auto body = body_of_link.find(name);
      if (body != body_of_link.end()) {
        pair[i] = body->second;
      } else {
        problems.add(place_in_text(text, link->begin, file),
                     fmt::format("link {} is not in {}", in_quotes(name), urdf) + offer(name, links, "links"));
      }
    }
    if (pair[0] > pair[1]) pair[0].swap(pair[1]);
    if (!pair[0].empty() && pair[0] != pair[1] && seen.insert(pair).second) pairs.push_back({pair[0], pair[1]});
  }
  return pairs;
}

}  // namespace gaitlab::interchange
