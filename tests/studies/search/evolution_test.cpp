// Tests of generations by ask and tell: ask() changes nothing, and tell() does. search_test compares them with pagmo.
#include "studies/search/evolution.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/messages.h"

namespace gaitlab::studies {
namespace {

/// Five points in a box of two coordinates, whose values are their distances from a corner.
EvolutionSettings settings_of(Method method, unsigned seed = 3) {
  EvolutionSettings s{
      .algorithm = method, .low = {0, 0}, .high = {1, 2}, .seed = seed, .sigma = 0.25, .points = {}, .values = {}};
  const std::size_t count = method == Method::nsga2 ? 8 : 7;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    s.points.push_back({share, 2 * share * share});
    s.values.push_back(method == Method::nsga2 ? Vector{share, 1 - share} : Vector{share});
  }
  return s;
}

/// Values that fall with the number of the point.
std::vector<Vector> falling(std::size_t count, std::size_t objectives, double from = -1) {
  std::vector<Vector> values;
  for (std::size_t k = 0; k < count; ++k) values.emplace_back(objectives, from - static_cast<double>(k));
  return values;
}

class EvolutionOf : public testing::TestWithParam<Method> {
 protected:
  const std::size_t objectives_ = GetParam() == Method::nsga2 ? 2 : 1;
};

TEST_P(EvolutionOf, AQuestionChangesNothing) {
  const auto evolved = pagmo_evolution(settings_of(GetParam()));
  const std::vector<Vector> points = evolved->points();
  EXPECT_EQ(points, settings_of(GetParam()).points);
  const std::vector<Vector> first = evolved->ask();
  EXPECT_GT(first.size(), 1U);
  for (const Vector& point : first) EXPECT_EQ(point.size(), 2U);
  EXPECT_EQ(evolved->ask(), first) << "asked again";
  EXPECT_EQ(evolved->points(), points);
  EXPECT_EQ(evolved->values(), settings_of(GetParam()).values);
}

/// If all values are better than those before, each requested point is in the population with its own value.
TEST_P(EvolutionOf, AnAnswerGivesEachPointItsValue) {
  const auto evolved = pagmo_evolution(settings_of(GetParam()));
  const std::vector<Vector> asked = evolved->ask();
  const std::vector<Vector> told = falling(asked.size(), objectives_);
  evolved->tell(told);
  const std::vector<Vector> points = evolved->points();
  const std::vector<Vector> values = evolved->values();
  ASSERT_EQ(points.size(), settings_of(GetParam()).points.size());
  std::size_t found = 0;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] != asked[k]) continue;
      ++found;
      EXPECT_EQ(values[i], told[k]);
    }
  }
  EXPECT_GE(found, points.size() - 1) << "sade and pso may keep one of the first";
  EXPECT_NE(evolved->ask(), asked);
}

TEST_P(EvolutionOf, ADifferentAnswerLeadsElsewhere) {
  const auto rising = pagmo_evolution(settings_of(GetParam()));
  const auto other = pagmo_evolution(settings_of(GetParam()));
  const std::vector<Vector> asked = rising->ask();
  ASSERT_EQ(other->ask(), asked) << "the seed is the same";
  std::vector<Vector> values = falling(asked.size(), objectives_);
  rising->tell(values);
  for (std::size_t k = 0; k < values.size(); k += 2) values[k].assign(objectives_, 100);  // every second one is bad
  other->tell(values);
  EXPECT_NE(rising->ask(), other->ask());
  EXPECT_NE(pagmo_evolution(settings_of(GetParam(), 4))->ask(), asked) << "of another seed";
}

/// The second pass may use only points that the first pass requested. Otherwise the generation would contain values of no run.
TEST_P(EvolutionOf, AnAnswerWithoutAQuestionIsRefused) {
  const auto evolved = pagmo_evolution(settings_of(GetParam()));
  EXPECT_EQ(test::message_of<RunError>([&] { evolved->tell({}); }),
            "a point of this generation depends on the result of another");
}

INSTANTIATE_TEST_SUITE_P(Methods, EvolutionOf,
                         testing::Values(Method::cma, Method::xnes, Method::sade, Method::pso, Method::nsga2),
                         [](const auto& method) { return std::string(name_of(method.param)); });

TEST(EvolutionLibrary, HasAVersion) { EXPECT_TRUE(std::string(evolution_library()).starts_with("pagmo 2.")); }

}  // namespace
}  // namespace gaitlab::studies
