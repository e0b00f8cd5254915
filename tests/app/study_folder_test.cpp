// Tests with forged folders of studies and with folders of users: FIFOs, names of shards, locks, files of other programs.
#include <sys/stat.h>

#include "app/study/study_quantities.h"
#include "studies/journal/database.h"
#include "studies/plan/definition.h"
#include "studies/run/runner.h"
#include "studies/study/study_file.h"
#include "tests/app/study_fixture.h"
#include "tests/folders.h"
#include "tests/messages.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

const std::string kInto = "sweep two.yaml --grid cpg.phase_lag=0.5:1.5:4 --quiet --out ";

class StudyFolder : public StudyFixture {
 protected:
  /// Expects the exit code and message of a command. A command that does not end is killed after ten minutes.
  void ends(const std::string& arguments, int code, const std::string& message, const std::string& before = "") {
    const Folder capture;
    const std::string command = "cd '" + folder_.path().string() + "' && " + before + " timeout -s KILL 600 '" +
                                std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' " + arguments + " >'" +
                                (capture / "out") + "' 2>'" + (capture / "err") + "'";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, code) << arguments;
    EXPECT_TRUE(read(capture / "err").starts_with(message)) << arguments << ": " << read(capture / "err");
  }
  void made(const std::string& arguments) {
    const Result result = call(arguments);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  void fifo(const std::string& name) {
    fs::remove(folder_ / name);
    ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0666), 0);
  }
  void copy(const std::string& from) {
    fs::remove_all(folder_ / "m");
    fs::copy(folder_ / from, folder_ / "m", fs::copy_options::recursive);
  }
  /// Bytes of a -journal that ends with the name of a file, as SQLite writes it for a transaction over several databases.
  static std::string journal_naming(const std::string& file) {
    const auto big_endian = [](std::uint32_t value) {
      std::string bytes;
      for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> static_cast<unsigned>(shift));
      return bytes;
    };
    std::uint32_t sum = 0;
    for (const char c : file) sum += static_cast<std::uint32_t>(static_cast<signed char>(c));
    return std::string(512, 'x') + big_endian(0x40000000 / 512 + 1) + file +
           big_endian(static_cast<std::uint32_t>(file.size())) + big_endian(sum) + "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  }
};

TEST_F(StudyFolder, NoFifoIsWaitedFor) {
  made(kInto + "whole");
  for (const char* shard : {"0/2", "1/2"}) made(kInto + "parts --shard " + shard);
  for (const char* behind : {"", "-wal", "-shm", "-journal"}) {
    copy("whole");
    const std::string file = std::string("m/study.db") + behind;
    fifo(file);
    const std::string refused = file + ": error: cannot be read: not a regular file\n";
    for (const char* command :
         {"study show m", "study report m", "study best m", "study export m --to csv t.csv", "study rerun m 1",
          "sweep two.yaml --grid cpg.phase_lag=0.5:1.5:4 --quiet --out n --answers m/study.db"})
      ends(command, 2, refused);
    ends(kInto + "m", 2, refused);
  }
  copy("whole");
  fifo("m/lock");
  ends("study show m", 0, "");
  ends(kInto + "m", 2, "m/lock: error: is not the lock of a study; expected a regular file without other links, ");
  copy("parts");
  fifo("m/shards/0-of-2.db");
  ends("study merge m", 2, "m/shards/0-of-2.db: error: cannot be read: not a regular file\n");
  copy("parts");
  fifo("m/shards/0-of-2.lock");
  ends(kInto + "m --shard 0/2", 2,
       "m/shards/0-of-2.lock: error: is not the lock of a study; expected a regular file without other links, ");
}

TEST_F(StudyFolder, NoLinkIsFollowedAndNoOtherFileIsDeleted) {
  made(kInto + "whole");
  copy("whole");
  fs::rename(folder_ / "m/study.db", folder_ / "elsewhere.db");
  fs::create_symlink(folder_ / "elsewhere.db", folder_ / "m/study.db");
  ends("study show m", 2, "m/study.db: error: cannot be read: is a link; name the file that it leads to\n");
  copy("whole");
  // SQLite would apply a -journal and delete the file that it names as its super-journal. The program must prevent this.
  const std::string mine = folder_.write("mine.txt", "precious");
  folder_.write("m/study.db-journal", journal_naming(mine));
  for (const char* command : {"study show m", "study merge m"})
    ends(command, 2, "m/study.db-journal: error: cannot be read: it names another file, which SQLite would delete");
  ends(kInto + "m", 2, "m/study.db-journal: error: cannot be read: it names another file, which SQLite would delete");
  EXPECT_EQ(read(mine), "precious");
}

TEST_F(StudyFolder, ThatIsNoStudysStaysAsItIs) {
  const std::string refused = ": error: exists and is not empty\n";
  fs::create_directories(folder_ / "u");
  folder_.write("u/lock", "my lock");
  folder_.write("u/table.csv", "my,table");
  ends(kInto + "u", 2, "--out u" + refused);
  EXPECT_EQ(read(folder_ / "u/lock"), "my lock");
  EXPECT_EQ(read(folder_ / "u/table.csv"), "my,table");
  fs::create_directories(folder_ / "data/shards");
  folder_.write("data/table.csv", "epoch,loss");
  ends(kInto + "data", 2, "--out data" + refused);
  ends(kInto + "data --shard 0/2", 2, "--out data" + refused);
  EXPECT_EQ(read(folder_ / "data/table.csv"), "epoch,loss");
  fs::create_directories(folder_ / "hard");
  folder_.write("theirs", "process 1 on here\n");
  fs::create_hard_link(folder_ / "theirs", folder_ / "hard/lock");
  ends(kInto + "hard", 2, "--out hard" + refused);
  EXPECT_EQ(read(folder_ / "theirs"), "process 1 on here\n");
  // A database of a different program is refused without a change of its journal mode.
  fs::create_directories(folder_ / "other");
  studies::Database(folder_ / "other/study.db", studies::Database::Mode::write).execute("CREATE TABLE mine(x)");
  const std::string bytes = read(folder_ / "other/study.db");
  ends(kInto + "other", 2, "other/study.db: error: is a database of SQLite, and not the journal of a study\n");
  EXPECT_EQ(read(folder_ / "other/study.db"), bytes);
  // A file `lock` of the user is preserved, also in the folder of a study.
  made(kInto + "s");
  folder_.write("s/lock", "mine");
  ends(kInto + "s", 2, "s/lock: error: is not the lock of a study; expected a regular file without other links, ");
  ends("study show s", 0, "");
  EXPECT_EQ(read(folder_ / "s/lock"), "mine");
}

// A sweep continues after kill -9, which leaves an empty study.db or one without tables, and a lock with or without its line.
TEST_F(StudyFolder, ThatAKilledSweepLeftGoesOn) {
  fs::create_directories(folder_ / "a");
  folder_.write("a/lock", "");
  folder_.write("a/study.db", "");
  made(kInto + "a");
  fs::create_directories(folder_ / "b/shards");
  folder_.write("b/shards/0-of-2.lock", "process 12 on machine\n");
  {
    studies::Database begun(folder_ / "b/shards/0-of-2.db", studies::Database::Mode::write);
    begun.write_ahead();
  }
  made(kInto + "b --shard 0/2");
  made(kInto + "b --shard 1/2");
  made("study merge b");
}

TEST_F(StudyFolder, ShardsThatNoDivisionHasAreRefused) {
  for (const char* shard : {"0/2", "1/2"}) made(kInto + "parts --shard " + shard);
  for (const char* name :
       {"7-of-2.db", "2-of-2.db", "9999999-of-2.db", "01-of-2.db", "1-of-02.db", "0-of-0.db", "1-of-99999999999999999999.db"}) {
    copy("parts");
    fs::copy(folder_ / "m/shards/1-of-2.db", folder_ / (std::string("m/shards/") + name));
    ends("study merge m", 2,
         std::string("m/shards/") + name +
             ": error: is not a shard of a study; expected I-of-N.db with I from 0 to N - 1, without zeros in front\n");
  }
}

TEST_F(StudyFolder, MissingShardsAreToldAsRanges) {
  made(kInto + "parts --shard 0/2");
  fs::create_directories(folder_ / "m/shards");
  fs::copy(folder_ / "parts/shards/0-of-2.db", folder_ / "m/shards/0-of-9999999.db");
  ends("study merge m", 1,
       "m: error: 9999998 of 9999999 shards are missing or incomplete; run them again: --array=1-9999998\n");
  fs::remove(folder_ / "m/study.db");
  for (int k = 2; k < 600; k += 2)  // every second shard exists
    fs::copy(folder_ / "parts/shards/0-of-2.db", folder_ / ("m/shards/" + std::to_string(k) + "-of-9999999.db"));
  const Result many = call("study merge m");
  EXPECT_EQ(many.code, 1);
  EXPECT_TRUE(contains(many.err, "--array=1,3,5,7,")) << many.err;
  EXPECT_TRUE(contains(many.err, ",399 (and 100 more ranges; merge again after these to see them)\n")) << many.err;
}

TEST_F(StudyFolder, AnArrayOfOneTaskMerges) {
  made(kInto + "one --shard 0/1");
  const Result merged = call("study merge one");
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(merged.out, "one/study.db: 4 of 4 runs\n");
  fs::create_directories(folder_ / "two/shards");
  fs::copy(folder_ / "one/study.db", folder_ / "two/shards/0-of-1.db");
  EXPECT_EQ(call("study merge two").out, "two/study.db: 4 of 4 runs\n");
  studies::Database(folder_ / "one/study.db", studies::Database::Mode::write).execute("DELETE FROM run WHERE run = 2");
  ends("study merge one", 1, "one: error: 1 of 4 runs have not finished; continue with: gaitlab sweep two.yaml ");
}

// On a file system without flock(), such as Lustre without -o flock, a study is written without a lock.
TEST_F(StudyFolder, WithoutLocksAStudyIsWrittenAsARunIs) {
  folder_.write(
      "none.c",
      "#include <errno.h>\nint flock(int descriptor, int how) { (void)descriptor; (void)how; errno = ENOSYS; return -1; "
      "}\n");
  const std::string library = folder_ / "none.so";
  ASSERT_EQ(std::system(("cc -shared -fPIC -o '" + library + "' '" + (folder_ / "none.c") + "'").c_str()), 0);
  const std::string note =
      ": note: the file system has no locks (Function not implemented); let one process at a time write here\n";
  ends("run two.yaml --quiet --out r", 0, "r" + note, "LD_PRELOAD='" + library + "'");
  ends(kInto + "s", 0, "s" + note, "LD_PRELOAD='" + library + "'");
  ends("study show s", 0, "", "LD_PRELOAD='" + library + "'");
}

TEST_F(StudyFolder, TextsOfAJournalShowNoControlCharacters) {
  made(kInto + "s");
  studies::Database(folder_ / "s/study.db", studies::Database::Mode::write)
      .execute(
          "UPDATE study SET name = 'a' || char(0x202E) || 'b', build = 'c' || char(0x2066) || 'd' || char(0x9B), command = "
          "'e' || char(0x061C) || char(27), runs = 9");
  const Result shown = call("study show s");
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_TRUE(shown.out.starts_with("a\\xe2\\x80\\xaeb: 4 of 9 runs ended")) << shown.out;
  EXPECT_TRUE(contains(shown.out, "continue with: e\\xd8\\x9c\\x1b\n")) << shown.out;
  ASSERT_EQ(call("study report s").code, 0);
  EXPECT_TRUE(contains(read(folder_ / "s/speed.svg"), "gaitlab c\\xe2\\x81\\xa6d\\xc2\\x9b")) << read(folder_ / "s/speed.svg");
}

TEST_F(StudyFolder, AnInfiniteNumberIsNoneOfAJournal) {
  made(kInto + "s");
  for (const char* change :
       {"UPDATE run SET \"cpg.phase_lag\" = 9e999 WHERE run = 2", "UPDATE run SET speed = -9e999 WHERE run = 2",
        "UPDATE run SET violation = 9e999 WHERE run = 2", "UPDATE parameter SET high = 9e999"}) {
    copy("s");
    studies::Database(folder_ / "m/study.db", studies::Database::Mode::write).execute(change);
    ends("study report m", 2, "m/study.db: error: is not a journal that this program wrote: a number in it is infinite\n");
  }
}

TEST_F(StudyFolder, ErrorsOfARerunNameTheFolder) {
  made(kInto + "s");
  ends("study rerun s 9", 2, "RUN: error: 9 is not in the journal of s; it has 4 of 4 runs\n");
  studies::Database(folder_ / "s/study.db", studies::Database::Mode::write).execute("UPDATE run SET seed = -1 WHERE run = 1");
  ends("study rerun s 1 --out x", 2, "s/study.db: error: run 1 has seed=-1: seed is -1; expected 0 to 9e+18\n");
}

// A rerun whose files cannot be written counts as failed, not as bad input. A limit of 50 kB per file (of the shell, in blocks
// of 512 bytes), which is less than the trace, acts like a full disk.
TEST_F(StudyFolder, ARerunThatCannotBeWrittenFails) {
  made(kInto + "s");
  ends("study rerun s 1 --out again", 1, "gaitlab: error: again/trace.h5: cannot be written: ", "ulimit -f 100;");
  // summary.json is tried twice, the second time with the files that were lost meanwhile.
  const std::string run = "cd '" + folder_.path().string() + "' && { ulimit -f 0; '" +
                          std::string(gaitlab::test::build_folder()) +
                          "/bin/gaitlab' run two.yaml --quiet --no-report --out full; } 2>&1 | cat >said";
  ASSERT_EQ(std::system(run.c_str()), 0);
  const std::string said = read(folder_ / "said"), lost = "gaitlab: error: full/summary.json: cannot be written: ";
  EXPECT_TRUE(contains(said, lost)) << said;
  EXPECT_EQ(said.find(lost), said.rfind(lost)) << said;
  EXPECT_EQ(call("study rerun s 1 --out third").code, 0);
}

TEST_F(StudyFolder, MemoryThatIsNotEnoughIsToldWithARemedy) {
  folder_.write("study.yaml",
                "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0, high: 1}}\n"
                "method: {type: random}\nbudget: {runs: 8}\n");
  const studies::Plan plan(studies::read_study(folder_ / "study.yaml", studies::Purpose::sweep), app::quantity_offer(),
                           catalog());
  studies::Journal journal(folder_ / "study.db", studies::journal_head(plan), studies::Journal::Build::same);
  const studies::Executor executor = [](const studies::Work&, std::atomic<bool>&) -> bool { throw std::bad_alloc(); };
  studies::Runner runner(plan, journal, {.executor = executor, .shard = {}, .jobs = 64});
  std::atomic<bool> stop = false;
  EXPECT_EQ(message_of<RunError>([&] { runner.run(8, stop); }),
            (folder_ / "study.db") +
                ": the memory is not enough for 64 threads; take fewer with -j, or raise the limit (ulimit -v, a "
                "container's); the runs that have ended are in the journal");
}

}  // namespace
}  // namespace gaitlab::test
