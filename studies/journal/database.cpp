#include "studies/journal/database.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <new>
#include <system_error>

#include "core/errors.h"
#include "core/files/folder_lock.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

/// True if a file is on a network file system, whose clients do not share memory. The constants are f_type values of statfs:
/// NFS, SMB, CIFS, Lustre, GPFS, FUSE, 9p.
bool on_network(const std::filesystem::path& file) {
  constexpr std::array<unsigned long, 8> kNetworks{0x6969,     0x517B,     0xFF534D42, 0xFE534D42,
                                                   0x0BD00BD0, 0x47504653, 0x65735546, 0x01021997};
  struct statfs about {};
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::statfs(folder.c_str(), &about) != 0) return false;
  return std::ranges::find(kNetworks, static_cast<unsigned long>(about.f_type)) != kNetworks.end();
}

/// True if the rollback journal ends with the name of a super-journal, which a transaction over several databases leaves. This
/// program never writes a super-journal. SQLite would delete the file with that name in any folder.
bool names_another_file(const std::filesystem::path& journal) {
  constexpr std::string_view kMagic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::ifstream file(journal, std::ios::binary);
  std::array<char, kMagic.size()> end{};
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(end.data(), end.size()) && std::string_view(end.data(), end.size()) == kMagic;
}

/// Checks the database and the files beside it before SQLite opens them by name, because SQLite would block on a FIFO and
/// follow links.
void check_files(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost = std::uintmax_t{1} << 40;  // bytes: enough for 2e9 runs
  for (const char* behind : {"", "-wal", "-shm", "-journal"}) {
    std::filesystem::path one = file;
    one += behind;
    const auto refuse = [&](const std::string& why) {
      throw InputError(SourceLocation{one.string()}, "cannot be read: " + why);
    };
    struct stat about {};
    if (::lstat(one.c_str(), &about) != 0) {
      if (errno != ENOENT) refuse(std::generic_category().message(errno));
      continue;
    }
    if (S_ISLNK(about.st_mode)) refuse("is a link; name the file that it leads to");
    if (S_ISDIR(about.st_mode)) refuse(std::generic_category().message(EISDIR));
    if (!S_ISREG(about.st_mode)) refuse("not a regular file");
    if (static_cast<std::uintmax_t>(about.st_size) > kMost)
      refuse(fmt::format("it has {} bytes; expected at most {}", about.st_size, kMost));
    if (std::string_view(behind) == "-journal" && names_another_file(one))
      refuse("it names another file, which SQLite would delete; gaitlab writes no such journal");
  }
}

/// URI of a file with options for opening: `file:`, the path, and the options.
std::string uri(const std::filesystem::path& file, const char* options) {
  std::string text = "file:";
  for (const char c : file.string()) {
    if (c == '%' || c == '?' || c == '#') {
      text += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  return text + options;
}

}  // namespace

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  check_files(file);
  const bool write = mode == Mode::write;
  // Reading a leftover log requires the shared memory file beside the database. Without write permission and without a log, the
  // database cannot change; it is then opened as immutable.
  std::filesystem::path log = file;
  log += "-wal";
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const bool fixed = !write && ::access(folder.c_str(), W_OK) != 0 && !std::filesystem::exists(log);
  // Without locks, SQLite would refuse every access. Then only one process may write, as the note demands. The layer unix-none
  // locks nothing. The option nolock=1 is not used, because it also excludes the write-ahead log.
  const bool locks = fixed || has_record_locks(folder, write);
  // A reader of an empty file would mistake the rollback journal of the process that creates the database for a remnant, and
  // delete it.
  std::error_code none;
  if (!locks && !write && std::filesystem::file_size(file, none) == 0)
    throw InputError(SourceLocation{file.string()}, "is empty: no process has written a study here yet");
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(uri(file, fixed ? "?immutable=1" : "").c_str(), &opened,
                      SQLITE_OPEN_URI | (write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY),
                      locks ? nullptr : "unix-none");
  database_.reset(opened);
  if (code != SQLITE_OK) fail(code);
  for (const auto& [option, on] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                   {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                   {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                   {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0},
                                   {SQLITE_DBCONFIG_ENABLE_FTS3_TOKENIZER, 0},
                                   {SQLITE_DBCONFIG_DQS_DML, 0},
                                   {SQLITE_DBCONFIG_DQS_DDL, 0}})
    sqlite3_db_config(opened, option, on, nullptr);
  constexpr int kLongest = 64 << 20;  // bytes of a text or row
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kLongest);
  sqlite3_limit(opened, SQLITE_LIMIT_ATTACHED, 0);
  constexpr int kPatience = 5000;  // ms to wait for another writer, such as a merge beside a sweep
  sqlite3_busy_timeout(opened, kPatience);
  execute("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0");
  // A reader without a lock would otherwise remove the log of the process that writes.
  if (!locks && !write) sqlite3_db_config(opened, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  // This must precede the first access to a write-ahead log, because that access otherwise uses shared memory.
  if (!locks || (write && on_network(file))) execute("PRAGMA locking_mode = EXCLUSIVE");
}

void Database::write_ahead() { execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL"); }

void Database::fail(int code) const {
  const std::string text = database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code);
  const auto refuse = [&](const std::string& what) { return InputError(SourceLocation{file_.string()}, what); };
  switch (code & 0xFF) {
    case SQLITE_NOTADB:
      throw refuse("is not a database of SQLite");
    case SQLITE_CORRUPT:
      throw refuse("is damaged: " + text);
    case SQLITE_ERROR:
      throw refuse("is not the journal of a study: " + text);
    case SQLITE_CANTOPEN:
      throw refuse("cannot be opened: " + text);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw RunError(file_.string() + ": another program is writing it: " + text);
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    default:
      throw RunError(file_.string() + ": cannot be written: " + text + "; its content is kept");
  }
}

void Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

std::int64_t Database::integer(const std::string& sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.integer(0) : 0;
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* made = nullptr;
  const int code = sqlite3_prepare_v2(database.database_.get(), sql.c_str(), -1, &made, nullptr);
  statement_.reset(made);
  check(code);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_->fail(code);
}

Statement& Statement::bind(int at, double value) {
  // SQLite stores -0 as an integer without its sign, so that -0 is stored as 0 here.
  check(std::isfinite(value) ? sqlite3_bind_double(statement_.get(), at + 1, value + 0.0)
                             : sqlite3_bind_null(statement_.get(), at + 1));
  return *this;
}

Statement& Statement::bind(int at, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), at + 1, value));
  return *this;
}

Statement& Statement::bind(int at, const std::string& value) {
  check(sqlite3_bind_text64(statement_.get(), at + 1, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind_null(int at) {
  check(sqlite3_bind_null(statement_.get(), at + 1));
  return *this;
}

Statement& Statement::bind_row(const Statement& from) {
  for (int k = 0; k < from.columns(); ++k)
    check(sqlite3_bind_value(statement_.get(), k + 1, sqlite3_column_value(from.statement_.get(), k)));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(statement_.get());
  if (code != SQLITE_DONE) database_->fail(code);
  return false;
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }
bool Statement::null(int at) const { return sqlite3_column_type(statement_.get(), at) == SQLITE_NULL; }
double Statement::number(int at) const {
  const double value = sqlite3_column_double(statement_.get(), at);
  if (std::isfinite(value)) return value;
  throw InputError(SourceLocation{database_->file_.string()},
                   "is not a journal that this program wrote: a number in it is infinite");
}
std::int64_t Statement::integer(int at) const { return sqlite3_column_int64(statement_.get(), at); }

std::string Statement::text(int at) const {
  if (null(at)) return {};
  if (sqlite3_column_type(statement_.get(), at) == SQLITE_FLOAT) return number_text(number(at));
  const void* bytes = sqlite3_column_text(statement_.get(), at);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), at));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.execute("ROLLBACK");
  } catch (const std::exception&) {  // SQLite has already rolled the transaction back, for example after a full disk
  }
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

std::string identifier(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace gaitlab::studies
