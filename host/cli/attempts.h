// The steps at the end of a render. The failure of one, or a signal in it, does not prevent the others.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/last_steps.h"
#include "errors.h"

namespace phlux::cli {

class Attempts {
public:
  /// Runs a step; what it throws is kept. `name` is that of its file, or says what it computes.
  template<class Step>
  void operator()(const std::string& name, const Step& step) {
    try {
      step();
    } catch (const StepInterrupted&) {
      interrupted_.push_back(name);
    } catch (const Error& error) {
      failed(error);
    } catch (const std::bad_alloc&) {
      failed(WriteError(name + ": not written: out of memory: a smaller `size` needs less"));
    } catch (const std::exception& error) {
      failed(WriteError(name + ": not written: " + error.what()));
    }
  }
  void failed(const Error& error) { errors_.push_back(error); }

  /// Prints a line for each failure, and one for the steps that a signal ended. Returns the exit code: that
  /// of the first failure, of an interruption, or `otherwise`.
  [[nodiscard]] int report(int otherwise) const;

private:
  std::vector<Error> errors_;
  std::vector<std::string> interrupted_; // names of steps
};

/// Prints the first line of an error to standard error, options by their names.
void print_error(const std::string& message);

} // namespace phlux::cli
