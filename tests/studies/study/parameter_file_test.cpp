// Tests of parameters and replicates in a study and on the command line, also of refused ones.
#include "studies/study/parameter_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gaitlab::studies {
namespace {

using Texts = std::vector<std::string>;

Texts told(const Problems& problems) {
  Texts all;
  for (const Problem& p : problems.list()) {
    all.push_back((p.place.line > 0 ? std::to_string(p.place.line) + ":" + std::to_string(p.place.column) + ": " : "") +
                  p.text);
  }
  return all;
}

/// Parameters of a study whose key `parameters` has this value, in line 1.
struct ReadParameters {
  explicit ReadParameters(const std::string& value) {
    const Node root = parse_yaml("parameters: " + value + "\n", "s.yaml");
    Study study;
    read_parameters(*root.find("parameters"), study, problems_);
    list = study.parameters;
    wrong = told(problems_);
  }
  std::vector<Parameter> list;
  Texts wrong;

 private:
  Problems problems_;
};

TEST(Parameters, AreRangesOrLists) {
  const ReadParameters read(
      "{cpg.frequency: {low: 0.1, high: 10, scale: log, count: 5}, cpg.offset: {low: -1, high: 1}, cpg.type: {values: [hopf, "
      "sine]}, physics.step: {values: [1e-3, 0.0020]}}");
  ASSERT_EQ(read.wrong, Texts{});
  ASSERT_EQ(read.list.size(), 4U);
  const Parameter& frequency = read.list[0];
  EXPECT_EQ(frequency.key, "cpg.frequency");
  EXPECT_EQ(frequency.low, 0.1);
  EXPECT_EQ(frequency.high, 10);
  EXPECT_TRUE(frequency.log);
  EXPECT_EQ(frequency.count, 5);
  EXPECT_FALSE(read.list[1].log);
  EXPECT_FALSE(read.list[1].in_grid()) << "drawn";
  EXPECT_EQ(read.list[2].values, (Texts{"hopf", "sine"}));
  EXPECT_TRUE(read.list[2].words);
  EXPECT_EQ(read.list[3].values, (Texts{"0.001", "0.002"})) << "as --set writes them, whatever the file's digits";
  EXPECT_FALSE(read.list[3].words);
}

TEST(Parameters, MayHaveFollowers) {
  const ReadParameters read("{legs: {low: 0, high: 1, sets: {cpg.offset: 0.3*legs - 0.1, cpg.amplitude: legs}}}");
  ASSERT_EQ(read.wrong, Texts{});
  const std::vector<Follower>& sets = read.list.at(0).sets;
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].key, "cpg.offset");
  EXPECT_EQ(sets[0].expression.text, "0.3*legs - 0.1");
  EXPECT_EQ(sets[1].key, "cpg.amplitude");
  EXPECT_EQ(sets[1].place.line, 1);
}

TEST(Parameters, ThatAreWrongSayWhere) {
  const auto wrong = [](const std::string& value) { return ReadParameters(value).wrong; };
  EXPECT_EQ(wrong("{}"), Texts{"1:13: parameters is empty; expected keys of the scenario: cpg.frequency: {low: 0.1, high: 1}"});
  EXPECT_EQ(wrong("[a]").size(), 1U);
  EXPECT_EQ(wrong("{a: {low: 1, high: 1}}"), Texts{"1:14: a: low is 1, not below high, 1"});
  EXPECT_EQ(wrong("{a: {low: 2, high: 1}}"), Texts{"1:14: a: low is 2, not below high, 1"});
  EXPECT_EQ(wrong("{a: {low: 0, high: 1, scale: log}}"), Texts{"1:14: a: low is 0; expected more than 0 for a logarithm"});
  EXPECT_EQ(wrong("{a: {low: -2, high: -1, scale: log}}").size(), 1U);
  EXPECT_EQ(wrong("{a: {low: 1}}").size(), 1U) << "high is missing";
  EXPECT_EQ(wrong("{a: {values: []}}"), Texts{"1:26: a.values is empty; expected a list of values: [0.5, 1, 2]"});
  EXPECT_EQ(wrong("{a: {values: [1, two]}}"), Texts{"1:26: a.values mixes numbers and words; expected one or the other"});
  EXPECT_EQ(wrong("{a: {values: [1, 1.0]}}"), Texts{"1:30: a.values holds '1' twice"});
  EXPECT_EQ(wrong("{a: {values: [1, [2]]}}"), Texts{"1:30: a.values holds a list; expected numbers or words"});
  EXPECT_EQ(wrong("{a: {values: [1, 2], low: 0}}"), Texts{"1:26: a has values, and low or high; expected one or the other"});
  EXPECT_EQ(wrong("{a: {low: 0, high: 1, sets: {}}}"),
            Texts{"1:41: a.sets is empty; expected keys of the scenario with expressions: {cpg.offset: 0.3*a}"});
  EXPECT_EQ(wrong("{a: {values: [x, y], sets: {k: 2*a}}}"),
            Texts{"1:40: a has words, which no expression can use; expected numbers beside sets"});
  for (const char* name : {"a.b", "2a", "_a", "pi", "and", "or", "not"}) {
    EXPECT_EQ(wrong(std::string("{") + name + ": {low: 0, high: 1, sets: {k: 1}}}"),
              Texts{std::string("1:14: '") + name +
                    "' cannot be a parameter of the study with `sets`; expected a name of letters, digits and `_` that begins "
                    "with a letter, as in hip0: {low: 0.1, high: 0.2, sets: {cpg.offset.hips: hip0}}"});
  }
}

TEST(OptionGrid, IsARangeOrAList) {
  Problems problems;
  const Parameter range = read_parameter("--grid", "cpg.frequency=0.1:10:5", false, problems);
  EXPECT_EQ(range.key, "cpg.frequency");
  EXPECT_EQ(range.low, 0.1);
  EXPECT_EQ(range.high, 10);
  EXPECT_EQ(range.count, 5);
  EXPECT_FALSE(range.log);
  const Parameter log = read_parameter("--grid", "k=log:0.1:10:3", false, problems);
  EXPECT_TRUE(log.log);
  EXPECT_EQ(log.count, 3);
  const Parameter words = read_parameter("--grid", "cpg.type=hopf,sine", false, problems);
  EXPECT_EQ(words.values, (Texts{"hopf", "sine"}));
  EXPECT_TRUE(words.words);
  const Parameter drawn = read_parameter("--random", "k=log:0.1:10", true, problems);
  EXPECT_TRUE(drawn.log);
  EXPECT_EQ(drawn.count, 0);
  EXPECT_FALSE(drawn.in_grid());
  EXPECT_EQ(read_parameter("--random", "k=5", true, problems).values, Texts{"5"});
  EXPECT_EQ(told(problems), Texts{});
}

TEST(OptionGrid, ThatIsWrongSaysWhatIsExpected) {
  const auto wrong = [](const std::string& text, bool drawn = false) {
    Problems problems;
    const Parameter p = read_parameter(drawn ? "--random" : "--grid", text, drawn, problems);
    EXPECT_EQ(p.place.file, (drawn ? "--random " : "--grid ") + text);
    return told(problems);
  };
  const Texts grid{"expected KEY=LOW:HIGH:N, KEY=log:LOW:HIGH:N or KEY=v,v,v"};
  for (const char* text : {"k", "=1:2:3", "k=", "k=1:2", "k=1:2:3:4", "k=log:1:2", "k=log"})
    EXPECT_EQ(wrong(text), std::string(text) == "k=log" ? Texts{} : grid) << text;
  for (const char* text : {"k=1:2:3", "k=log:1", "k=:1:2"})
    EXPECT_EQ(wrong(text, true), Texts{"expected KEY=LOW:HIGH, KEY=log:LOW:HIGH or KEY=v,v,v"}) << text;
  EXPECT_EQ(wrong("k=2:1:3"), Texts{"k: low is 2, not below high, 1"});
  EXPECT_EQ(wrong("k=log:0:1:3"), Texts{"k: low is 0; expected more than 0 for a logarithm"});
  for (const char* n : {"1", "0", "-3", "1000000001"})
    EXPECT_EQ(wrong(std::string("k=1:2:") + n), Texts{std::string("N is ") + n + "; expected 2 to 1e9"});
  EXPECT_EQ(wrong("k=1:2:1000000000"), Texts{});
  EXPECT_EQ(wrong("k=1:2:3.5").size(), 1U);
  EXPECT_EQ(wrong("k=a:b:3").size(), 2U) << "both ends";
  EXPECT_EQ(wrong("k=1,1"), Texts{"k holds '1' twice"});
  EXPECT_EQ(wrong("k=1,,2").size(), 1U) << "an empty word is no number";
}

/// Replicates of a study whose key `replicates` has this value.
struct ReadReplicates {
  explicit ReadReplicates(const std::string& value) {
    const Node root = parse_yaml("replicates: " + value + "\n", "s.yaml");
    Problems problems;
    read_replicates(*root.find("replicates"), replicates, problems);
    wrong = told(problems);
  }
  Replicates replicates;
  Texts wrong;
};

TEST(ReplicatesKey, HasLawsOfDraws) {
  const ReadReplicates read(
      "{count: 8, combine: quantile(0.9), vary: {ground.friction: {uniform: [0.6, 1]}, a: {normal: [1, 0.1], low: 0.5}, b: "
      "{times: "
      "{values: [0.9, 1.1]}}, c: {values: [x, y]}}}");
  ASSERT_EQ(read.wrong, Texts{});
  EXPECT_EQ(read.replicates.count, 8);
  EXPECT_EQ(read.replicates.combine, Combine::quantile);
  EXPECT_EQ(read.replicates.quantile, 0.9);
  const std::vector<Variation>& vary = read.replicates.vary;
  ASSERT_EQ(vary.size(), 4U);
  EXPECT_EQ(vary[0].law, Variation::Law::uniform);
  EXPECT_EQ(vary[0].a, 0.6);
  EXPECT_EQ(vary[0].b, 1);
  EXPECT_EQ(vary[1].law, Variation::Law::normal);
  EXPECT_EQ(vary[1].low, 0.5);
  EXPECT_FALSE(vary[1].high.has_value());
  EXPECT_FALSE(vary[1].times);
  EXPECT_TRUE(vary[2].times);
  EXPECT_EQ(vary[2].values, (Texts{"0.9", "1.1"}));
  EXPECT_TRUE(vary[3].words);
}

TEST(ReplicatesKey, CombinesByName) {
  const auto combined_by = [](const std::string& how) { return ReadReplicates("{count: 2, combine: " + how + "}"); };
  EXPECT_EQ(combined_by("mean").replicates.combine, Combine::mean);
  EXPECT_EQ(combined_by("worst").replicates.combine, Combine::worst);
  EXPECT_EQ(combined_by("median").replicates.combine, Combine::median);
  EXPECT_EQ(combined_by("quantile(0)").replicates.quantile, 0);
  EXPECT_EQ(combined_by("quantile(1)").replicates.quantile, 1);
  EXPECT_EQ(combined_by("share(0.7)").replicates.combine, Combine::share);
  EXPECT_EQ(combined_by("share(0.7)").replicates.quantile, 0.7);
  for (const char* how : {"share", "share()", "share(2)", "share(-0.1)", "share(x)", "mean(0.5)", "quantile(Q)",
                          "quantile(1.1)", "quantile(-0.1)", "quantile()", "quantile", "best", "[mean]"}) {
    const Texts wrong = combined_by(how).wrong;
    ASSERT_EQ(wrong.size(), 1U) << how;
    EXPECT_TRUE(wrong[0].ends_with("expected mean, worst, median, quantile(Q), share(Q) with Q from 0 to 1")) << wrong[0];
  }
}

TEST(ReplicatesKey, ThatIsWrongSaysWhy) {
  const auto wrong = [](const std::string& law) { return ReadReplicates("{count: 2, vary: {k: " + law + "}}").wrong; };
  EXPECT_EQ(wrong("{uniform: [1, 1]}"), Texts{}) << "one value";
  EXPECT_EQ(wrong("{uniform: [2, 1]}"), Texts{"1:44: k is not uniform: [LOW, HIGH] with LOW at most HIGH"});
  EXPECT_EQ(wrong("{uniform: [1]}"), Texts{"1:44: k is not uniform: [LOW, HIGH]"});
  EXPECT_EQ(wrong("{uniform: [1, 2, 3]}"), Texts{"1:44: k is not uniform: [LOW, HIGH]"});
  EXPECT_EQ(wrong("{uniform: [one, 2]}"), Texts{"1:44: k is not uniform: [LOW, HIGH]"});
  EXPECT_EQ(wrong("{normal: [1, -0.1]}"), Texts{"1:43: k has a deviation of -0.1; expected at least 0"});
  EXPECT_EQ(wrong("{normal: [1, 0.1], low: 1.5}"), Texts{"1:34: k: the mean, 1, is not between low and high"});
  EXPECT_EQ(wrong("{normal: [1, 0.1], low: 0, high: 0.5}"), Texts{"1:34: k: the mean, 1, is not between low and high"});
  EXPECT_EQ(wrong("{normal: [1, 0.1], low: 0, high: 2}"), Texts{});
  EXPECT_EQ(wrong("{}"),
            Texts{"1:34: k has no law; expected one of normal: [MEAN, DEVIATION], uniform: [LOW, HIGH], values: [...]"});
  EXPECT_EQ(wrong("{uniform: [0, 1], values: [1]}"),
            Texts{"1:34: k has several laws; expected one of normal: [MEAN, DEVIATION], uniform: [LOW, HIGH], values: [...]"});
  EXPECT_EQ(wrong("{times: {values: [x, y]}}"), Texts{"1:51: k: words cannot multiply a value"});
  EXPECT_EQ(wrong("{times: {times: {uniform: [0, 1]}}}").empty(), false) << "a factor of a factor";
  EXPECT_EQ(wrong("{uniform: [0, 1], low: 0}").size(), 1U) << "an end of a normal law";
  EXPECT_EQ(ReadReplicates("{combine: mean}").wrong.size(), 1U) << "count is missing";
  EXPECT_EQ(ReadReplicates("{count: 2, vary: [k]}").wrong,
            Texts{"1:30: vary is a list; expected keys: ground.friction: {uniform: [0.6, 1]}"});
}

}  // namespace
}  // namespace gaitlab::studies
