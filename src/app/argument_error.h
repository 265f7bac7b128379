#pragma once

#include <stdexcept>
#include <string>

namespace lemma {

/// The command line asks for what cannot be done. what() is one message for the user.
class ArgumentError : public std::runtime_error {
 public:
  /// @param hint  what could be done instead
  ArgumentError(const std::string& what, const std::string& hint)
      : std::runtime_error("lemma: error: " + what + "\n  hint: " + hint) {}
};

}  // namespace lemma
