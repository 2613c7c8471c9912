// Images: compared and merged with themselves, or a FileError.
#include "errors.h"
#include "files/compare.h"
#include "files/exr.h"
#include "files/merge.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const Input input(bytes, count);
  try {
    const phlux::files::Image image = phlux::files::read_exr(input.file());
    phlux::files::Merger merger;
    try {
      merger.add("a.exr", image);
      static_cast<void>(merger.result());
    } catch (const phlux::FileError&) {
    }
    static_cast<void>(phlux::files::compare(image, image, "a.exr", "b.exr"));
  } catch (const phlux::FileError&) {
  }
  return 0;
}
