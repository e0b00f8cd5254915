// The test programs: GoogleTest's, with entries for CTest and the CPU time of each test.
//     core_tests --ctest            prints the entries, with labels (tests/labels.h), as a file that CTest includes
//     GAITLAB_CPU=FILE core_tests   appends `seconds name` of each test to FILE, with the children that it waited for
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/labels.h"

namespace gaitlab::test {
namespace {

// Cases that a filter of GoogleTest chooses: `*`, `?`, `:` between patterns, and after a `-` those that it leaves out.
bool matches(const char* pattern, const char* name) {
  if (*pattern == '\0' || *pattern == ':' || *pattern == '-') return *name == '\0';
  if (*pattern == '*') return matches(pattern + 1, name) || (*name != '\0' && matches(pattern, name + 1));
  return *name != '\0' && (*pattern == '?' || *pattern == *name) && matches(pattern + 1, name + 1);
}

bool matches_any(const std::string& patterns, const std::string& name) {
  for (std::size_t at = 0; at < patterns.size(); ++at) {
    if (matches(patterns.c_str() + at, name.c_str())) return true;
    at = patterns.find(':', at);
    if (at == std::string::npos) break;
  }
  return false;
}

bool chosen(const std::string& filter, const std::string& name) {
  const std::size_t dash = filter.find('-');
  return matches_any(filter.substr(0, dash), name) &&
         (dash == std::string::npos || !matches_any(filter.substr(dash + 1), name));
}

std::string joined(const std::set<std::string>& names, const char* between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
  return text;
}

void print_entry(const char* program, const std::string& name, const std::string& filter,
                 const std::set<std::string>& labels_of_it) {
  std::printf("add_test([[%s]] [[%s]] [[--gtest_filter=%s]])\n", name.c_str(), program, filter.c_str());
  if (!labels_of_it.empty())
    std::printf("set_tests_properties([[%s]] PROPERTIES LABELS [[%s]])\n", name.c_str(), joined(labels_of_it, ";").c_str());
}

// Prints the entries of CTest. A label that chooses no test is an error.
int print_entries(const char* program) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::set<std::string> unused;
  for (const Label* label : Label::all()) unused.insert(label->filter);
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    std::set<std::string> alone;
    int others = 0;
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const std::string name = std::string(suite.name()) + "." + suite.GetTestInfo(k)->name();
      if (std::string(suite.GetTestInfo(k)->name()).rfind("DISABLED_", 0) == 0) continue;
      std::set<std::string> own;
      for (const Label* label : Label::all()) {
        if (!chosen(label->filter, name)) continue;
        own.insert(label->names);
        unused.erase(label->filter);
      }
      if (own.empty()) {
        ++others;
      } else {
        alone.insert(name);
        print_entry(program, name, name, own);
      }
    }
    if (others > 0)
      print_entry(program, suite.name(), std::string(suite.name()) + ".*" + (alone.empty() ? "" : "-" + joined(alone, ":")),
                  {});
  }
  for (const std::string& filter : unused) std::fprintf(stderr, "a label of no test: %s\n", filter.c_str());
  return unused.empty() ? 0 : 1;
}

double cpu_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& t : {used.ru_utime, used.ru_stime})
      sum += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }
  return sum;
}

class CpuOfTests : public testing::EmptyTestEventListener {
 public:
  explicit CpuOfTests(const char* file) : out_(file, std::ios::app) {}
  void OnTestStart(const testing::TestInfo&) override { begin_ = cpu_seconds(); }
  void OnTestEnd(const testing::TestInfo& test) override {
    out_ << cpu_seconds() - begin_ << ' ' << test.test_suite_name() << '.' << test.name() << std::endl;
  }

 private:
  std::ofstream out_;
  double begin_ = 0;
};

}  // namespace

}  // namespace gaitlab::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc == 2 && std::string(argv[1]) == "--ctest") return gaitlab::test::print_entries(argv[0]);
  if (const char* file = std::getenv("GAITLAB_CPU"))
    testing::UnitTest::GetInstance()->listeners().Append(new gaitlab::test::CpuOfTests(file));
  return RUN_ALL_TESTS();
}
