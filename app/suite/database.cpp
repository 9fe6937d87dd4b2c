#include "app/suite/database.h"

#include <sqlite3.h>

#include "io/input_error.h"

namespace app {

void Database::Close::operator()(sqlite3* handle) const { ::sqlite3_close(handle); }

Database::Database(const std::filesystem::path& file) : file_(file) {
  sqlite3* handle = nullptr;
  const int status = ::sqlite3_open(file.c_str(), &handle);
  handle_.reset(handle);
  if (status != SQLITE_OK) Fail();
  constexpr int kPatience_ms = 10000;  // somebody may be reading
  ::sqlite3_busy_timeout(handle, kPatience_ms);
}

void Database::Execute(const std::string& sql) {
  if (::sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail();
}

void Database::Fail() const {
  throw io::InputError(file_.string(), std::string(::sqlite3_errmsg(handle())) +
                                           "; mend the place, or name another folder");
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  ::sqlite3_finalize(statement);
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  if (::sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement, nullptr) !=
      SQLITE_OK) {
    database.Fail();
  }
  statement_.reset(statement);
}

Statement& Statement::Bind(const std::string& text) {
  ::sqlite3_bind_text(statement_.get(), next_++, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::Bind(std::int64_t number) {
  ::sqlite3_bind_int64(statement_.get(), next_++, number);
  return *this;
}

Statement& Statement::Bind(const std::optional<double>& number) {
  if (number) {
    ::sqlite3_bind_double(statement_.get(), next_++, *number);
  } else {
    ::sqlite3_bind_null(statement_.get(), next_++);
  }
  return *this;
}

bool Statement::Step() {
  const int status = ::sqlite3_step(statement_.get());
  if (status != SQLITE_ROW && status != SQLITE_DONE) database_.Fail();
  return status == SQLITE_ROW;
}

void Statement::Run() {
  while (Step()) {
  }
  ::sqlite3_reset(statement_.get());
  next_ = 1;
}

std::string Statement::Text(int column) const {
  const unsigned char* text = ::sqlite3_column_text(statement_.get(), column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

std::int64_t Statement::Whole(int column) const {
  return ::sqlite3_column_int64(statement_.get(), column);
}

std::optional<double> Statement::Number(int column) const {
  if (::sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  return ::sqlite3_column_double(statement_.get(), column);
}

}  // namespace app
