#include <catch2/catch.hpp>

#include "device/condition.h"
#include "device/embedded.h"
#include "device/program.h"
#include "errors.h"
#include "temporary_folder.h"

using namespace phlux;
using namespace phlux::device;
using Catch::Contains;

TEST_CASE("defines come first, includes once, each part with its place") {
  const TemporaryFolder folder;
  folder.write("root.cl", "#include \"a.h\"\n#include \"sub/b.h\" // again a.h\nint root;\n");
  folder.write("a.h", "#pragma once\nint a;\n");
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("sub/b.h", "  #  include  \"a.h\"\nint b;"); // no newline at its end
  const auto text = expand(KernelFiles(folder.path()), {"root.cl", {{"WIDTH", "8"}}, "int extra;\n"});
  CHECK(text == "#define WIDTH 8\n"
                "#line 2 \"a.h\"\nint a;\n"
                "#line 2 \"sub/b.h\"\nint b;\n"
                "#line 3 \"root.cl\"\nint root;\n"
                "#line 1 \"extra\"\nint extra;\n");
}

TEST_CASE("a missing file is blamed on the line that includes it") {
  const TemporaryFolder folder;
  folder.write("root.cl", "\n#include \"a.h\"\n");
  folder.write("a.h", "int a;\n\n#include \"gone.h\"\n");
  CHECK_THROWS_AS(expand(KernelFiles(folder.path()), {"root.cl", {}, ""}), DeviceError);
  CHECK_THROWS_WITH(expand(KernelFiles(folder.path()), {"root.cl", {}, ""}),
                    Contains("a.h:3: ") && Contains("gone.h"));
  CHECK_THROWS_WITH(expand(KernelFiles(), {"no-such-kernel.cl", {}, ""}), Contains("no-such-kernel.cl"));
}

TEST_CASE("what the defines rule out is not in the text") {
  const TemporaryFolder folder;
  folder.write("sphere.h", "#ifndef SPHERE_H\n#define SPHERE_H\nint sphere;\n#endif\n");
  folder.write(
      "root.cl",
      "#ifdef SPHERES\n#include \"sphere.h\"\n#else\nint none;\n#endif\n"
      "#if LOBES > 1 && defined(SPHERES)\nint many;\n#elif LOBES == 1\nint one;\n#else\nint no;\n#endif\n"
      "#ifdef SPHERES\n#include \"sphere.h\"\n#endif\n");
  const KernelFiles files(folder.path());
  const auto parts = [&](std::map<std::string, std::string> defines) {
    return significant(expand(files, {"root.cl", std::move(defines), ""}));
  };
  CHECK(parts({}) == "int none;\nint no;\n");
  CHECK(parts({{"LOBES", "1"}}) == "#define LOBES 1\nint none;\nint one;\n");
  CHECK(parts({{"LOBES", "2"}, {"SPHERES", ""}}) ==
        "#define LOBES 2\n#define SPHERES \n#define SPHERE_H\nint sphere;\nint many;\n");
}

TEST_CASE("an unused feature leaves other programs as they were") {
  const TemporaryFolder folder;
  folder.write("root.cl", "int before;\nint after;\n");
  const auto before = expand(KernelFiles(folder.path()), {"root.cl", {}, ""});
  folder.write("feature.h", "int feature;\n");
  folder.write(
      "root.cl",
      "// The feature is new.\nint before;\n#ifdef FEATURE\n#include \"feature.h\"\n#endif\n\nint after;\n");
  const auto after = expand(KernelFiles(folder.path()), {"root.cl", {}, ""});
  CHECK(after != before); // its #line tags moved
  CHECK(significant(after) == significant(before));
}

TEST_CASE("conditions that the compiler decides stay") {
  const TemporaryFolder folder;
  folder.write("a.h", "#ifndef A_H\n#define A_H\nint a;\n#endif\n");
  folder.write("root.cl",
               "#if defined(__AVX512F__) && WIDTH == 16\n#include \"a.h\"\n#define FAST\n#elif WIDTH == 1\n"
               "int narrow;\n#else\nint slow;\n#endif\n#ifdef FAST\nint fast;\n#endif\n#include \"a.h\"\n");
  const KernelFiles files(folder.path());
  CHECK(significant(expand(files, {"root.cl", {{"WIDTH", "1"}}, ""})) ==
        "#define WIDTH 1\nint narrow;\n#define A_H\nint a;\n");
  CHECK(
      significant(expand(files, {"root.cl", {{"WIDTH", "16"}}, ""})) ==
      "#define WIDTH 16\n#if defined(__AVX512F__) && WIDTH == 16\n#define A_H\nint a;\n#define FAST\n"
      "#else\nint slow;\n#endif\n#ifdef FAST\nint fast;\n#endif\n#ifndef A_H\n#define A_H\nint a;\n#endif\n");
}

TEST_CASE("comments and continued lines hide and join directives") {
  const TemporaryFolder folder;
  folder.write(
      "root.cl",
      "/*\n#include \"gone.h\"\n*/\n#if 1 /* yes */ && \\\n  1 // and yes\nint a; \\\n#if\n#endif\n");
  CHECK(significant(expand(KernelFiles(folder.path()), {"root.cl", {}, ""})) ==
        "/*\n#include \"gone.h\"\n*/\nint a; \\\n#if\n");
}

TEST_CASE("wrong nesting is an error") {
  const TemporaryFolder folder;
  folder.write("open.cl", "#if 1\nint a;\n");
  folder.write("loop.cl", "#ifdef __GNUC__\n#include \"loop.h\"\n#endif\n");
  folder.write("loop.h", "#include \"loop.h\"\n");
  CHECK_THROWS_WITH(expand(KernelFiles(folder.path()), {"open.cl", {}, ""}),
                    Contains("open.cl: #if without #endif"));
  CHECK_THROWS_AS(expand(KernelFiles(folder.path()), {"loop.cl", {}, ""}), DeviceError);
}

TEST_CASE("conditions") {
  Macros macros;
  macros.define("WIDTH", "16");
  macros.define("WIDE", "(WIDTH >= 4)");
  macros.define_opaque("CALL");
  const auto truth = [&](const char* expression) { return evaluate(expression, macros); };

  for (const char* yes :
       {"1", "WIDTH", "WIDE", "WIDTH == 16", "defined WIDTH && !defined(NOBODY)", "NOBODY == 0",
        "1 + 2 * 3 == 7", "(1 + 2) * 3 == 9", "0x10u == 16UL", "-1 < 0", "1 << 3 == 8", "~0 == -1",
        "0 ? 0 : 1", "1 || __UNKNOWN", "defined(CALL)", "5 % 3 == 2 && 7 / 2 == 3", "(6 & 3) == 2"}) {
    CAPTURE(yes);
    CHECK(truth(yes) == true);
  }
  for (const char* no :
       {"0", "NOBODY", "WIDTH < 4", "!WIDE", "0 && __UNKNOWN", "defined(NOBODY)", "(6 ^ 6) | 0"}) {
    CAPTURE(no);
    CHECK(truth(no) == false);
  }
  for (const char* unknown :
       {"__UNKNOWN", "defined(__UNKNOWN)", "cl_khr_fp64 && WIDTH", "__has_builtin(__builtin_x(1))", "CALL",
        "CALL(3) == 3", "1 / 0", "(1", "1 +", "'a'", "1.5", "", "1 1", "__UNKNOWN ? 1 : 0"}) {
    CAPTURE(unknown);
    CHECK_FALSE(truth(unknown).has_value());
  }
  macros.define("LOOP", "LOOP");
  CHECK_FALSE(truth("LOOP").has_value());
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
  CHECK(embedded_files().size() == files);
}
