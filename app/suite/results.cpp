#include "app/suite/results.h"

#include <array>

#include "io/input_error.h"

namespace app {
namespace {

constexpr int kVersion = 1;  // of the tables
constexpr const char* kTables = R"sql(
CREATE TABLE IF NOT EXISTS cases (
  key TEXT PRIMARY KEY, scene TEXT NOT NULL, arm TEXT NOT NULL, seed INTEGER NOT NULL,
  variant TEXT NOT NULL, scene_sha256 TEXT NOT NULL, inputs_sha256 TEXT NOT NULL,
  program TEXT NOT NULL, command TEXT NOT NULL, status TEXT NOT NULL, message TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS figures (
  key TEXT NOT NULL REFERENCES cases, figure TEXT NOT NULL, value REAL,
  PRIMARY KEY (key, figure)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS times (
  key TEXT NOT NULL REFERENCES cases, time TEXT NOT NULL, value REAL,
  PRIMARY KEY (key, time)
) WITHOUT ROWID;
)sql";

CaseStatus StatusNamed(const std::string& name, const std::filesystem::path& file) {
  for (const CaseStatus status :
       {CaseStatus::kFinished, CaseStatus::kFailed, CaseStatus::kCrashed, CaseStatus::kTimedOut,
        CaseStatus::kOutOfMemory}) {
    if (name == NameOf(status)) return status;
  }
  throw io::InputError(file.string(), "has a case with the unknown status " + io::Quoted(name));
}

int VersionOf(Database& database, const std::string& schema) {
  Statement version(database, "PRAGMA " + schema + ".user_version");
  version.Step();
  return static_cast<int>(version.Whole(0));
}

/// Everything of a transaction, or nothing of it.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {
    database.Execute("BEGIN IMMEDIATE");
  }
  ~Transaction() {
    try {
      if (!committed_) database_.Execute("ROLLBACK");
    } catch (const io::InputError&) {  // the file is as it was before in any case
    }
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit() {
    database_.Execute("COMMIT");
    committed_ = true;
  }

 private:
  Database& database_;
  bool committed_ = false;
};

}  // namespace

void RequireResults(const std::filesystem::path& folder) {
  if (std::filesystem::is_regular_file(folder / kResultsFile)) return;
  throw io::InputError(folder.string(), "holds no " + std::string(kResultsFile) +
                                            "; name folders that `pas suite` wrote");
}

void RequireResultsFolder(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder) || std::filesystem::exists(folder / kResultsFile))
    return;
  if (!std::filesystem::is_directory(folder) || !std::filesystem::is_empty(folder)) {
    throw io::InputError(folder.string(),
                         "is neither empty nor a folder of results; name "
                         "another with -o");
  }
}

Results::Results(const std::filesystem::path& folder) : database_(folder / kResultsFile) {
  // A write-ahead log outlives the process; a loss of power may cost the last cases, no more.
  database_.Execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
  const int version = VersionOf(database_, "main");
  if (version == 0) {
    Transaction whole(database_);
    database_.Execute(kTables + ("PRAGMA user_version = " + std::to_string(kVersion)));
    whole.Commit();
  } else if (version != kVersion) {
    throw io::InputError(database_.file().string(),
                         "is of version " + std::to_string(version) + ", this program writes " +
                             std::to_string(kVersion) + "; name another folder");
  }
}

Results::~Results() {
  try {
    database_.Execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE");
  } catch (const io::InputError&) {  // somebody reads; the log stays beside the file
  }
}

void Results::Put(const SuiteCase& one, const CaseResult& result, const std::string& program,
                  const std::string& command) {
  Transaction whole(database_);
  for (const char* table : {"figures", "times", "cases"}) {
    Statement(database_, std::string("DELETE FROM ") + table + " WHERE key = ?")
        .Bind(one.key)
        .Run();
  }
  Statement(database_, "INSERT INTO cases VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .Bind(one.key)
      .Bind(one.scene)
      .Bind(eval::ArmOfKey(one.key))
      .Bind(static_cast<std::int64_t>(one.seed))
      .Bind(one.variant)
      .Bind(one.scene_sha256)
      .Bind(one.inputs_sha256)
      .Bind(program)
      .Bind(command)
      .Bind(NameOf(result.status))
      .Bind(result.message)
      .Run();
  const auto put = [&](const char* table, const eval::Figures& numbers) {
    Statement row(database_, std::string("INSERT INTO ") + table + " VALUES (?, ?, ?)");
    for (const auto& [name, value] : numbers) row.Bind(one.key).Bind(name).Bind(value).Run();
  };
  put("figures", result.figures);
  put("times", result.times);
  whole.Commit();
}

std::map<std::string, ResultRow> Results::Rows() {
  std::map<std::string, ResultRow> rows;
  Statement cases(database_, "SELECT key, inputs_sha256, command, status, message FROM cases");
  while (cases.Step()) {
    ResultRow& row = rows[cases.Text(0)];
    row.inputs_sha256 = cases.Text(1);
    row.command = cases.Text(2);
    row.result.status = StatusNamed(cases.Text(3), database_.file());
    row.result.message = cases.Text(4);
  }
  ReadNumbers("figures", &CaseResult::figures, rows);
  ReadNumbers("times", &CaseResult::times, rows);
  return rows;
}

void Results::ReadNumbers(const std::string& table, eval::Figures CaseResult::*into,
                          std::map<std::string, ResultRow>& rows) {
  Statement numbers(database_, "SELECT * FROM " + table);
  while (numbers.Step()) {
    (rows[numbers.Text(0)].result.*into)[numbers.Text(1)] = numbers.Number(2);
  }
}

void Results::Merge(const std::filesystem::path& folder) {
  RequireResults(folder);
  const std::filesystem::path file = folder / kResultsFile;
  Statement(database_, "ATTACH ? AS other").Bind(file.string()).Run();
  if (VersionOf(database_, "other") != kVersion) {
    throw io::InputError(file.string(), "is not of this version of pas suite; run it again");
  }
  {
    Statement differing(database_,
                        "SELECT key FROM main.cases JOIN other.cases USING (key) WHERE "
                        "main.cases.inputs_sha256 <> other.cases.inputs_sha256 LIMIT 1");
    if (differing.Step()) {
      throw io::InputError(file.string(), "has the case " + differing.Text(0) +
                                              " of other inputs than a folder before it; merge "
                                              "runs of one suite by one program");
    }
  }
  Transaction whole(database_);
  // A case that one folder could not finish and another did is done.
  database_.Execute(
      "CREATE TEMP TABLE mended AS SELECT key FROM main.cases JOIN other.cases USING (key) "
      "WHERE main.cases.status <> 'done' AND other.cases.status = 'done'");
  for (const std::string table : {"figures", "times", "cases"}) {
    database_.Execute("DELETE FROM main." + table + " WHERE key IN (SELECT key FROM mended)");
  }
  database_.Execute("DROP TABLE mended");
  for (const std::string table : {"figures", "times", "cases"}) {
    database_.Execute("INSERT INTO main." + table + " SELECT * FROM other." + table +
                      " WHERE key NOT IN (SELECT key FROM main.cases) ORDER BY 1, 2");
  }
  whole.Commit();
  database_.Execute("DETACH other");
}

}  // namespace app
