#include "cli/run.h"

int main(int argc, char** argv) {
  return phlux::cli::run(argc, argv);
}
