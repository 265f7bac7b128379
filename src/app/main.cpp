#include <fmt/format.h>

#include <exception>
#include <new>

#include "src/app/command_line.h"
#include "src/app/exit_code.h"

int main(int argc, char** argv) {
  try {
    return lemma::run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "lemma: error: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
  return lemma::kBadInput;
}
