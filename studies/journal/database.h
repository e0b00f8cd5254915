// SQLite file from an untrusted source, opened so that SQLite treats its content as data only.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace gaitlab::studies {

class Database;

/// A prepared statement. Columns and parameters are numbered from 0.
class Statement {
 public:
  Statement& bind(int at, double value);  ///< stores NaN and infinity as NULL
  Statement& bind(int at, std::int64_t value);
  Statement& bind(int at, const std::string& value);
  Statement& bind_null(int at);
  /// Binds the values of all columns of the current row of `from`.
  Statement& bind_row(const Statement& from);
  /// Advances to the next row. Returns false after the last row; the statement may then be bound again.
  bool step();
  /// Executes a statement that returns no rows.
  void run() { (void)step(); }
  [[nodiscard]] int columns() const;
  [[nodiscard]] bool null(int at) const;
  /// Throws InputError if the value is infinite, which bind() never writes.
  [[nodiscard]] double number(int at) const;
  [[nodiscard]] std::int64_t integer(int at) const;
  /// Value as text. A number is the shortest text that gives the same double, NULL is "". Throws InputError if it is infinite.
  [[nodiscard]] std::string text(int at) const;

 private:
  friend class Database;
  Statement(Database& database, const std::string& sql);
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code) const;
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A database. Throws InputError if the file is not a database, is damaged or cannot be opened, and RunError if the file cannot
/// be written.
class Database {
 public:
  enum class Mode { read, write };
  /// Opens the file without trust in its schema: extensions are disabled, and triggers and views of the file do not run. Throws
  /// InputError if the file, or a file that SQLite keeps beside it (-wal, -shm, -journal), is a link, a FIFO, a device or too
  /// large. Throws InputError also if the -journal contains the name of another file, because SQLite would delete that file.
  Database(const std::filesystem::path& file, Mode mode);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Switches to a write-ahead log, so that readers need not wait for the writer. On a network file system, one process then
  /// locks the database.
  void write_ahead();

  void execute(const std::string& sql);
  [[nodiscard]] Statement prepare(const std::string& sql) { return {*this, sql}; }
  /// Runs a query that returns a single number, and returns that number.
  std::int64_t integer(const std::string& sql);

 private:
  friend class Statement;
  [[noreturn]] void fail(int code) const;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A transaction, which the destructor rolls back unless commit() was called.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

/// Quotes a name for SQL, as in `"a.b"`.
std::string identifier(const std::string& name);

}  // namespace gaitlab::studies
