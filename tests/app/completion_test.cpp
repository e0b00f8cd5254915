// Tests of `gaitlab completion bash` and of the manual page: both know what the parser knows.
#include <sstream>

#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongCompletion("Completion.EveryCommandAndOptionOfTheHelpIsOfferedAndInTheManual", "long");

/// Words that may take the place of the last one.
std::string offered(const std::string& words) { return "\n" + gaitlab("completion bash -- " + words, "/").out; }

bool offers(const std::string& words, const std::string& word) { return contains(offered(words), "\n" + word + "\n"); }

/// First words of the lines of the help that begin with `start`.
std::vector<std::string> named_in_help(const std::string& command, const std::string& start) {
  std::istringstream help(gaitlab("help " + command, "/").out);
  std::vector<std::string> names;
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  " + start) || line.starts_with("   ")) continue;
    const std::string name = line.substr(2, line.find_first_of(" ,", 2) - 2);
    if (start.empty() == !name.starts_with("-")) names.push_back(name);
  }
  return names;
}

TEST(Completion, EveryCommandAndOptionOfTheHelpIsOfferedAndInTheManual) {
  const std::string manual = gaitlab("man", "/").out;
  const std::vector<std::string> commands = named_in_help("", "");
  EXPECT_GT(commands.size(), 20U);
  for (const std::string& command : commands) {
    EXPECT_TRUE(offers("''", command)) << command;
    EXPECT_TRUE(contains(manual, "\\fBgaitlab " + command)) << command;
    for (const std::string& option : named_in_help(command, "--"))
      EXPECT_TRUE(offers(command + " -", option)) << command << " " << option;
  }
  EXPECT_FALSE(offers("''", "reference"));  // hidden
}

TEST(Completion, ValuesAreThoseOfTheProgram) {
  EXPECT_EQ(offered("run x --format ''"), "\ncsv\nh5\n");
  EXPECT_EQ(offered("run x --format=c"), "\n--format=csv\n");
  EXPECT_EQ(offered("run x --format = c"), "\n--format=csv\n");  // bash divides the words at `=`
  EXPECT_EQ(offered("run hexa"), "\nhexapod\n:files\n");
  EXPECT_EQ(offered("swap x --cpg sine,hop"), "\nsine,hopf\n");
  EXPECT_EQ(offered("run x --set physics.eng"), "\nphysics.engine=\n");
  EXPECT_EQ(offered("run x --set physics.engine = art"), "\nphysics.engine=articulated\n");
  EXPECT_EQ(offered("explain engine art"), "\narticulated\n:files\n");
  EXPECT_EQ(offered("explain engi"), "\nengine\n:files\n");
  EXPECT_EQ(offered("list engi"), "\nengine\n");  // a file is not offered
  EXPECT_EQ(offered("remedy hexa"), "\n:files\n");
  EXPECT_EQ(offered("study sh"), "\nshow\n");
  EXPECT_EQ(offered("help study sh"), "\nshow\n");
  EXPECT_EQ(offered("run x -j ''"), "\n");  // the option expects a number, so that nothing is offered
  EXPECT_EQ(offered("run x y ''"), "\n");   // this argument would be one too many
  EXPECT_EQ(offered("run --out ''"), "\n:files\n");
  EXPECT_EQ(offered("run -- --qui"), "\n:files\n");
  EXPECT_EQ(gaitlab("completion fish", "/").code, 2);
}

}  // namespace
}  // namespace gaitlab::test
