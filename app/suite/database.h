#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace app {

/// A file of SQLite. All calls throw InputError naming the file and what is wrong with it.
class Database {
 public:
  /// Makes the file if it is not there.
  explicit Database(const std::filesystem::path& file);

  /// Statements without a result.
  void Execute(const std::string& sql);
  [[noreturn]] void Fail() const;
  sqlite3* handle() const { return handle_.get(); }
  const std::filesystem::path& file() const { return file_; }

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement: values are bound in the order of its question marks.
class Statement {
 public:
  /// @param database  must outlive the statement
  Statement(Database& database, const std::string& sql);

  Statement& Bind(const std::string& text);
  Statement& Bind(std::int64_t number);
  Statement& Bind(const std::optional<double>& number);
  /// The next row; false when there is none. @throws InputError
  bool Step();
  /// Runs to the end and makes it ready for other values.
  void Run();

  std::string Text(int column) const;
  std::int64_t Whole(int column) const;
  std::optional<double> Number(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int next_ = 1;
};

}  // namespace app
