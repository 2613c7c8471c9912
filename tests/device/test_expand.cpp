#include <catch2/catch.hpp>

#include "device/program.h"
#include "errors.h"
#include "sources/embedded.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::device;
using Catch::Contains;
using sources::KernelFiles;

TEST_CASE("defines come first, includes once, each part with its place") {
  const TemporaryFolder folder;
  folder.write("root.cl", "#include \"a.h\"\n#include \"sub/b.h\" // again a.h\nint root;\n");
  folder.write("a.h", "int a;\n");
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("sub/b.h", "  #  include  \"a.h\"\nint b;"); // no newline at its end
  const auto text = expand(KernelFiles(folder.path()), {"root.cl", {{"WIDTH", "8"}}, {}, "int extra;\n"});
  CHECK(text == "#define WIDTH 8\n"
                "#line 1 \"a.h\"\nint a;\n"
                "#line 2 \"sub/b.h\"\nint b;\n"
                "#line 3 \"root.cl\"\nint root;\n"
                "#line 1 \"extra\"\nint extra;\n");
}

TEST_CASE("a missing file is blamed on the line that includes it") {
  const TemporaryFolder folder;
  folder.write("root.cl", "\n#include \"a.h\"\n");
  folder.write("a.h", "int a;\n\n#include \"gone.h\"\n");
  folder.write("macro.cl", "#include STRATEGY\n");
  CHECK_THROWS_AS(expand(KernelFiles(folder.path()), {"root.cl", {}, {}, ""}), DeviceError);
  CHECK_THROWS_WITH(expand(KernelFiles(folder.path()), {"root.cl", {}, {}, ""}),
                    Contains("a.h:3: ") && Contains("gone.h"));
  CHECK_THROWS_WITH(expand(KernelFiles(), {"no-such-kernel.cl", {}, {}, ""}), Contains("no-such-kernel.cl"));
  CHECK_THROWS_WITH(expand(KernelFiles(folder.path()), {"macro.cl", {}, {}, ""}),
                    Contains("macro.cl:1: ") && Contains("STRATEGY"));
}

TEST_CASE("a program's own files stand for those of kernels/, and a define may name a file") {
  const TemporaryFolder folder;
  folder.write("root.cl", "#include \"a.h\"\n#include STRATEGY\n");
  folder.write("a.h", "int from_kernels;\n");
  const ProgramSource source{
      "root.cl", {{"STRATEGY", "\"b.cl\""}}, {{"a.h", "int own;\n"}, {"b.cl", "int strategy;\n"}}, ""};
  CHECK(significant(expand(KernelFiles(folder.path()), source)) ==
        "#define STRATEGY \"b.cl\"\nint own;\nint strategy;\n");
}

TEST_CASE("a block comment hides includes") {
  const TemporaryFolder folder;
  folder.write("root.cl", "/*\n#include \"gone.h\"\n*/ // /*\nint a;\n");
  CHECK(significant(expand(KernelFiles(folder.path()), {"root.cl", {}, {}, ""})) ==
        "/*\n#include \"gone.h\"\n*/ // /*\nint a;\n");
}

TEST_CASE("a file that includes itself is read once") {
  const TemporaryFolder folder;
  folder.write("loop.h", "#include \"loop.h\"\nint a;\n");
  CHECK(significant(expand(KernelFiles(folder.path()), {"loop.h", {}, {}, ""})) == "int a;\n");
}

TEST_CASE("the embedded kernels are the files of kernels/") {
  const std::filesystem::path folder = PHLUX_SOURCE_DIR "/kernels";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cl") continue;
    ++files;
    const auto name = entry.path().lexically_relative(folder).string();
    CAPTURE(name);
    CHECK(KernelFiles().read(name) == TemporaryFolder::read(entry.path()));
  }
  CHECK(sources::embedded_files().size() == files);
}
