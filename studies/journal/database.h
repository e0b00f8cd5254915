// SQLite file from an untrusted source: opened so that its content is only data.
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

/// A prepared statement; columns and parameters count from 0.
class Statement {
 public:
  Statement& bind(int at, double value);  ///< NaN: NULL
  Statement& bind(int at, std::int64_t value);
  Statement& bind(int at, const std::string& value);
  Statement& bind_null(int at);
  /// Binds all columns of another statement's present row.
  Statement& bind_row(const Statement& from);
  /// Advances to the next row; false: there is none, and the statement may be bound again.
  bool step();
  /// For statements without rows.
  void run() { (void)step(); }
  [[nodiscard]] int columns() const;
  [[nodiscard]] bool null(int at) const;
  /// Throws InputError if it is infinite, which bind() never writes.
  [[nodiscard]] double number(int at) const;
  [[nodiscard]] std::int64_t integer(int at) const;
  /// Numbers as the shortest text that gives the same double; NULL as "". Throws as above.
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

/// A database. Throws InputError if the file is not a database, is damaged or cannot be opened; RunError if it cannot be
/// written.
class Database {
 public:
  enum class Mode { read, write };
  /// Opens the file: schemas are not trusted, there are no extensions, triggers and views of the file do not run. Throws
  /// InputError if the file, or a file that SQLite keeps beside it (-wal, -shm, -journal), is a link, a FIFO, a device or too
  /// large, or if its -journal names another file, which SQLite would delete.
  Database(const std::filesystem::path& file, Mode mode);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Switches to a write-ahead log, on which readers need not wait; on a network file system the database is then locked by one
  /// process.
  void write_ahead();

  void execute(const std::string& sql);
  [[nodiscard]] Statement prepare(const std::string& sql) { return {*this, sql}; }
  /// The single number that a query returns.
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

/// A transaction: rolled back unless committed.
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

/// Quotes a name for SQL: `"a.b"`.
std::string identifier(const std::string& name);

}  // namespace gaitlab::studies
