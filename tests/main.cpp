// The test programs: GoogleTest's, with entries for CTest and the CPU time of each test.
//     core_tests --ctest FILE       writes the entries, with labels (tests/labels.h), as a file that CTest includes
//     GAITLAB_CPU=FILE core_tests   appends `seconds name` of each test to FILE, with the children that it waited for
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <string>

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

/// The file of CTest: an entry per suite, and one for each test with a label.
class Entries {
 public:
  Entries(const char* program, const char* file) : program_(std::filesystem::absolute(program)), out_(file) {
    for (const Label* label : Label::all()) unused_.insert(label->filter);
  }

  void add(const testing::TestSuite& suite) {
    std::set<std::string> labelled;
    bool others = false;
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const std::string name = std::string(suite.name()) + "." + suite.GetTestInfo(k)->name();
      const std::set<std::string> labels = labels_of(name);
      if (labels.empty()) {
        others = true;
      } else {
        labelled.insert(name);
        write(name, name, labels);
      }
    }
    const std::string all = std::string(suite.name()) + ".*";
    if (others) write(suite.name(), labelled.empty() ? all : all + "-" + joined(labelled, ":"), {});
  }

  /// Labels that chose no test, a line each.
  std::string unused() const { return joined(unused_, "\n"); }

 private:
  std::set<std::string> labels_of(const std::string& name) {
    std::set<std::string> found;
    for (const Label* label : Label::all()) {
      if (!chosen(label->filter, name)) continue;
      found.insert(label->names);
      unused_.erase(label->filter);
    }
    return found;
  }

  void write(const std::string& name, const std::string& filter, const std::set<std::string>& labels) {
    out_ << "add_test([[" << name << "]] [[" << program_ << "]] [[--gtest_filter=" << filter << "]])\n";
    if (!labels.empty())
      out_ << "set_tests_properties([[" << name << "]] PROPERTIES LABELS [[" << joined(labels, ";") << "]])\n";
  }

  std::string program_;
  std::ofstream out_;
  std::set<std::string> unused_;
};

// A label that chooses no test is an error.
int write_entries(const char* program, const char* file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  Entries entries(program, file);
  for (int s = 0; s < all.total_test_suite_count(); ++s) entries.add(*all.GetTestSuite(s));
  if (entries.unused().empty()) return 0;
  std::cerr << "labels of no test:\n" << entries.unused() << '\n';
  return 1;
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
  if (argc == 3 && std::string(argv[1]) == "--ctest") return gaitlab::test::write_entries(argv[0], argv[2]);
  if (const char* file = std::getenv("GAITLAB_CPU"))
    testing::UnitTest::GetInstance()->listeners().Append(new gaitlab::test::CpuOfTests(file));
  return RUN_ALL_TESTS();
}
