// The steps at the end of a render. The failure of one does not prevent the others.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "errors.h"

namespace phlux::cli {

class Attempts {
public:
  /// Runs a step; what it throws is kept. `name` is that of its file.
  template<class Step>
  void operator()(const std::string& name, const Step& step) {
    try {
      step();
    } catch (const Error& error) {
      failed(error);
    } catch (const std::bad_alloc&) {
      failed(WriteError(name + ": not written: out of memory: a smaller `size` needs less"));
    } catch (const std::exception& error) {
      failed(WriteError(name + ": not written: " + error.what()));
    }
  }
  void failed(const Error& error) { errors_.push_back(error); }

  /// Prints a line for each failure. Returns the exit code: that of the first failure, or `otherwise`.
  [[nodiscard]] int report(int otherwise) const;

private:
  std::vector<Error> errors_;
};

/// Prints the first line of an error to standard error, options by their names.
void print_error(const std::string& message);

} // namespace phlux::cli
