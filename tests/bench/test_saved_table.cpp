#include <catch2/catch.hpp>

#include "bench/common/methods/reference.h"
#include "bench/common/tables/array_file.h"
#include "bench/common/tables/saved_table.h"
#include "errors.h"
#include "temporary_folder.h"

using namespace phlux::bench;

TEST_CASE("A saved table is read back and continued") {
  const TemporaryFolder folder;
  {
    SavedTable table(folder.path(), "t.csv", {"name", "value"});
    CHECK(table.rows().empty());
    table.add({"a", "1"});
    table.add({"b", ""});
    table.write();
  }
  CHECK(TemporaryFolder::read(folder / "t.csv") == "name,value\na,1\nb,\n");
  SavedTable table(folder.path(), "t.csv", {"name", "value"});
  REQUIRE(table.rows().size() == 2);
  CHECK(table.value(table.rows()[1], "name") == "b");
  CHECK(table.value(table.rows()[1], "value").empty());
  table.remove_if([](const auto& row) { return row[0] == "a"; });
  CHECK(table.rows().size() == 1);
  CHECK(SavedTable(folder.path(), "t.csv", {"name", "other"}).rows().empty());
}

TEST_CASE("A saved table drops rows that are incomplete or have other columns") {
  const TemporaryFolder folder;
  folder.write("t.csv", "name,value\na,1\nb,2,3\nc,4");
  const SavedTable table(folder.path(), "t.csv", {"name", "value"});
  REQUIRE(table.rows().size() == 1);
  CHECK(table.rows()[0][0] == "a");
}

TEST_CASE("A table in a read-only folder is an error") {
  CHECK_THROWS_AS(SavedTable("/proc/phlux", "t.csv", {"a"}).write(), phlux::WriteError);
}

TEST_CASE("References are read back only for the same settings") {
  const TemporaryFolder folder;
  phlux::scene::Camera camera;
  camera.width = 2, camera.height = 1;
  const ReferenceImage reference{noisy_reference({1, 2, 3, 4, 5, 6}, {0.5, 0.5, 0.5, 2, 2, 2}, 2),
                                 {3.5, 0.25, 7},
                                 8,
                                 "path mis",
                                 7,
                                 100};
  write_reference(folder / "s.exr", "abc", reference, camera);
  const auto read = read_reference(folder / "s.exr", "abc");
  REQUIRE(read);
  CHECK(read->image.radiance == reference.image.radiance);
  CHECK(read->image.variance == reference.image.variance);
  CHECK(read->image.weights == reference.image.weights);
  CHECK(read->mean.degrees == 7);
  CHECK(read->mean.standard_error == reference.mean.standard_error);
  CHECK(read->method == reference.method);
  CHECK_FALSE(read_reference(folder / "s.exr", "abd"));
  CHECK_FALSE(read_reference(folder / "none.exr", "abc"));
  folder.write("s.exr", "damaged");
  CHECK_THROWS_WITH(read_reference(folder / "s.exr", "abc"), Catch::Contains("delete it"));
}

TEST_CASE("Arrays have the format of NumPy") {
  const TemporaryFolder folder;
  write_array(folder / "a.npy", {2, 1}, {1.0, -0.5});
  const std::string bytes = TemporaryFolder::read(folder / "a.npy");
  CHECK(bytes.starts_with(std::string("\x93NUMPY\x01\x00", 8)));
  CHECK(bytes.size() % 64 == 8);
  CHECK_THAT(bytes, Catch::Contains("'shape': (2, 1,)"));
  CHECK(bytes.substr(bytes.size() - 8) == std::string("\x00\x00\x80\x3f\x00\x00\x00\xbf", 8));
}
