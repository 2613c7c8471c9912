// Films whose sums of samples are in a file.
#include "film/paged_array.h"

#include <catch2/catch.hpp>

#include "device/environment.h"
#include "errors.h"
#include "film/film.h"
#include "temporary_folder.h"

using namespace phlux::film;

TEST_CASE("an array in a file has the values of one in memory") {
  const TemporaryFolder folder;
  const Environment variable("TMPDIR", folder.path());
  using Array = PagedArray<double>;
  constexpr std::size_t size = 2 * Array::most_in_window + 3; // three windows, the last one small
  Array array;
  array.resize(size, Storage::file);
  CHECK(array.size() == size);
  CHECK(array[size - 1] == 0.0);
  for (const int factor : {1, 2})
    for (std::size_t i = 0; i < size; i += 1001) array[i] += static_cast<double>(i) * factor;
  const Array& as_const = array;
  std::size_t i = 0;
  for (const double value : Elements(as_const)) {
    if (value != (i % 1001 == 0 ? 3.0 * static_cast<double>(i) : 0.0)) FAIL(i);
    ++i;
  }
  CHECK(i == size);
  CHECK(folder.names().empty()); // the file has no name
}

TEST_CASE("a film in a file has the means and variances of one in memory") {
  const int width = 1024, height = 520; // of two windows
  Film memory(width, height), file(width, height, Storage::file);
  for (Film* const film : {&memory, &file}) {
    film->use_splats();
    for (int block = 0; block < 2; ++block) {
      film->use_dependent_samples(); // a render that resumes says so again
      for (std::size_t pixel = 0; pixel < film->pixels().size(); ++pixel) {
        const auto x = static_cast<float>(pixel % 100 + 7 * static_cast<std::size_t>(block));
        film->add(pixel, {{x, 2 * x, 3}, {x * x, 4 * x * x, 9}}, 16);
      }
    }
    film->add_splatting_paths(16 * film->pixels().size());
    film->add_splat(1000, {1, 2, 3});
  }
  for (std::size_t pixel = 0; pixel < memory.pixels().size(); ++pixel)
    if (memory.mean(pixel) != file.mean(pixel) ||
        memory.variance_of_mean(pixel) != file.variance_of_mean(pixel))
      FAIL(pixel);
  CHECK(memory.relative_standard_error() == file.relative_standard_error());
}

TEST_CASE("where a file cannot be made, the error names the folder and the remedy") {
  const Environment variable("TMPDIR", "/nowhere");
  CHECK(ScratchFile::room() == 0.0);
  CHECK_THROWS_AS(ScratchFile(8), phlux::WriteError);
  CHECK_THROWS_WITH(ScratchFile(8), "/nowhere: a temporary file for the film cannot be made: No such file or "
                                    "directory: name another folder by the variable TMPDIR");
}
