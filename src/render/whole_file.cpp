#include "src/render/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <system_error>

namespace lemma {
namespace {

namespace fs = std::filesystem;

FileError cannot_write(const fs::path& path, std::string_view why, std::string_view hint) {
  return FileError(fmt::format("{}: error: cannot be written: {}\n  hint: {}", path.string(), why, hint));
}

/// Beside the target and no other process's.
fs::path temporary_name(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.tmp", path.filename().string(), ::getpid());
}

bool write(const fs::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  return file.flush().good();
}

/// What a link leads to; a path that is no link, itself.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target;
}

/// Nothing can take the place of a device or a pipe.
bool is_device(const fs::path& path) {
  std::error_code ignored;
  return fs::is_other(path, ignored);
}

/// Removes what stands under a temporary name, if anything does.
void discard(const fs::path& temporary) {
  std::error_code ignored;
  fs::remove(temporary, ignored);
}

/// Checks that what may stand under the name already may be replaced.
void check_replaceable(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw cannot_write(path, "it is a folder", "name a file, for example one in this folder");
  }
  if (fs::exists(path, ignored) && ::access(path.c_str(), W_OK) != 0) {
    throw cannot_write(path, "the file is write-protected", "choose another name, or make it writable");
  }
}

}  // namespace

void check_whole_file(const fs::path& path) {
  check_replaceable(path);
  const fs::path target = target_of(path);
  if (is_device(target)) return;
  const fs::path temporary = temporary_name(target);
  const bool creatable = write(temporary, "");
  discard(temporary);
  if (creatable) return;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  throw cannot_write(path, fmt::format("the folder {} does not exist or takes no files", folder.string()),
                     "make the folder, or choose another name");
}

void write_whole_file(const fs::path& path, std::string_view bytes) {
  const fs::path target = target_of(path);
  const bool in_place = is_device(target);
  const fs::path file = in_place ? target : temporary_name(target);
  std::error_code error;
  const bool written = write(file, bytes);
  if (written && !in_place) fs::rename(file, target, error);
  if (written && !error) return;
  if (!in_place) discard(file);
  throw cannot_write(path, error ? error.message() : "no more fits there",
                     "free space, or choose another name");
}

}  // namespace lemma
