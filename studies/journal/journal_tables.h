// SQL statements that create the tables of a journal.
#pragma once
#include <array>

namespace gaitlab::studies {

inline constexpr int kApplication = 0x67616974;  ///< PRAGMA application_id, the bytes `gait`
inline constexpr int kSchema = 1;                ///< PRAGMA user_version, the version of the tables

struct JournalTable {
  const char* name;
  const char* sql;
};

/// All tables except `run`, whose columns depend on the study.
inline constexpr std::array<JournalTable, 9> kTables{{
    {"study",
     "CREATE TABLE study(name TEXT NOT NULL, created TEXT NOT NULL, build TEXT NOT NULL, definition TEXT NOT NULL, "
     "scenario TEXT NOT NULL, command TEXT NOT NULL, seed INTEGER NOT NULL, runs INTEGER NOT NULL, replicates INTEGER NOT "
     "NULL, "
     "combine TEXT NOT NULL, quantile REAL NOT NULL, guarded INTEGER NOT NULL, method TEXT NOT NULL, told INTEGER NOT NULL, "
     "torque_error REAL NOT NULL, "
     "worlds TEXT NOT NULL) STRICT"},
    {"parameter",
     "CREATE TABLE parameter(number INTEGER PRIMARY KEY, column_name TEXT NOT NULL, key TEXT NOT NULL, kind TEXT NOT NULL, "
     "low REAL, high REAL, scale TEXT, words TEXT) STRICT"},
    {"quantity",
     "CREATE TABLE quantity(number INTEGER PRIMARY KEY, column_name TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, "
     "meaning TEXT NOT NULL, shown INTEGER NOT NULL) STRICT"},
    {"objective",
     "CREATE TABLE objective(number INTEGER PRIMARY KEY, expression TEXT NOT NULL, direction TEXT NOT NULL) STRICT"},
    {"constraint",
     "CREATE TABLE \"constraint\"(number INTEGER PRIMARY KEY, expression TEXT NOT NULL, guard INTEGER NOT NULL) STRICT"},
    {"effort",
     "CREATE TABLE effort(pack INTEGER PRIMARY KEY, first_run INTEGER NOT NULL, runs INTEGER NOT NULL, started TEXT NOT NULL, "
     "wall REAL NOT NULL, host TEXT NOT NULL, process INTEGER NOT NULL) STRICT"},
    {"attempt", "CREATE TABLE attempt(run INTEGER PRIMARY KEY, started INTEGER NOT NULL) STRICT"},
    {"search",
     "CREATE TABLE search(search INTEGER NOT NULL, generation INTEGER NOT NULL, restart INTEGER NOT NULL, first_run INTEGER "
     "NOT "
     "NULL, runs INTEGER NOT NULL, points INTEGER NOT NULL, kept INTEGER NOT NULL, best REAL, median REAL, spread REAL NOT "
     "NULL, PRIMARY KEY(search, generation)) STRICT"},
    {"verification",
     "CREATE TABLE verification(number INTEGER PRIMARY KEY, run INTEGER NOT NULL, kind TEXT NOT NULL, name TEXT NOT NULL, "
     "objective REAL, objective_2 REAL, objective_3 REAL, violation REAL, verdict TEXT NOT NULL, verified INTEGER NOT NULL, "
     "reason TEXT NOT "
     "NULL, cause TEXT NOT NULL) STRICT"},
}};

}  // namespace gaitlab::studies
