#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "device/device.h"
#include "temporary_folder.h"

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

long columns_of(const std::string& line) {
  return std::count(line.begin(), line.end(), ',') + 1;
}

// Whether the charts are there; without matplotlib they cannot be, and the exit code says so.
bool has_charts(const Outcome& outcome) {
  if (outcome.err.find("python3-matplotlib") == std::string::npos) {
    CHECK(outcome.exit_code == 0);
    return true;
  }
  WARN("no matplotlib: the charts are not tested");
  CHECK(outcome.exit_code == 5);
  return false;
}

} // namespace

TEST_CASE("phlux bench rays writes the contract's columns") {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({{"bench", "rays", "--triangles", "36,1000", "--out", "out/new"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  if (has_charts(outcome)) {
    CHECK_THAT(TemporaryFolder::read(folder / "out/new/index.html"), Catch::Contains("Rays against Embree"));
    CHECK_THAT(TemporaryFolder::read(folder / "out/new/rays-rates.svg"), Catch::Contains("</svg>"));
  }
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/new/rays.csv"));
  REQUIRE(lines.size() == 7);
  CHECK_THAT(lines[0],
             Catch::StartsWith("scene,triangles,kind,device,layout,mrays_per_s,embree_mrays_per_s,ratio"));
  CHECK_THAT(lines[1], Catch::StartsWith("knot,36,") && Catch::Contains(",brute x"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  for (const char* kind : {",camera,", ",bounce,", ",shadow,"})
    CHECK_THAT(outcome.out, Catch::Contains(kind));
}

TEST_CASE("phlux bench sampling writes the contract's columns, a row for each strategy and case") {
  const TemporaryFolder folder;
  const Invocation invocation{{"bench", "sampling", "--out", ".", "--samples", "1000", "--strategy", "exact",
                               "--strategy", "rejection", "--case", ".4,.05,50,30", "--case", "0,1,1e6,89",
                               "--integrand", "constant"},
                              folder.path(),
                              {},
                              {}};
  const Outcome outcome = run(invocation);
  CAPTURE(outcome.err);
  if (has_charts(outcome)) {
    CHECK_THAT(TemporaryFolder::read(folder / "sampling-tradeoff-constant.svg"), Catch::Contains("</svg>"));
    CHECK_THAT(TemporaryFolder::read(folder / "index.html"), Catch::Contains("Sampling strategies"));
  }
  const auto lines = lines_of(TemporaryFolder::read(folder / "sampling.csv"));
  REQUIRE(lines.size() == 4); // rejection would need too many proposals in the second case
  CHECK_THAT(lines[0], Catch::StartsWith("strategy,kd,ks,n,theta_deg,samples,mean,exact,bias_sigma,variance,"
                                         "variance_standard_error,rays_per_sample,ns_per_sample,"
                                         "variance_times_cost"));
  CHECK(lines[0].ends_with(",integrand"));
  CHECK_THAT(lines[1], Catch::StartsWith("exact,0.4,0.05,50,30,"));
  CHECK_THAT(lines[2], Catch::StartsWith("rejection,0.4,0.05,50,30,"));
  CHECK_THAT(lines[3], Catch::StartsWith("exact,0,1,1000000,89,"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  for (std::size_t i = 1; i < lines.size(); ++i) CHECK(lines[i].ends_with(",constant"));
  CHECK(lines_of(TemporaryFolder::read(folder / "sampling-no-roulette.csv")).size() == 4);
  CHECK_THAT(outcome.out, Catch::Contains("rejection is left out of 1 cases"));

  const Outcome again = run(invocation);
  CHECK(again.exit_code == outcome.exit_code);
  CHECK_THAT(again.out, Catch::Contains("2 of 2 measurements are there"));
}

TEST_CASE("phlux bench sampling --quick draws maps in light and dark") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"bench", "sampling", "--quick", "--samples", "1", "--strategy", "cosine",
                                "--strategy", "exact", "--integrand", "mirror-disk"},
                               folder.path(),
                               {},
                               {}});
  CAPTURE(outcome.err);
  if (!has_charts(outcome)) return;
  for (const char* name : {"winners", "tradeoff", "cost"}) {
    const std::string chart = folder / (std::string("bench-results/sampling-") + name + "-mirror-disk");
    CHECK_THAT(TemporaryFolder::read(chart + ".png"), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(chart + "-dark.png"), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(chart + ".svg"), Catch::Contains("prefers-color-scheme:dark"));
  }
}

TEST_CASE("phlux bench arithmetic writes a table, its charts and a section of the report") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"bench", "arithmetic", "--quick", "--out", "out"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/arithmetic.csv"));
  REQUIRE(lines.size() > 50);
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  if (!has_charts(outcome)) return;
  for (const char* chart : {"lobe", "sine", "geometry", "functions"})
    CHECK_THAT(TemporaryFolder::read(folder / (std::string("out/arithmetic-") + chart + ".svg")),
               Catch::Contains("</svg>"));
  CHECK_THAT(TemporaryFolder::read(folder / "out/index.html"), Catch::Contains("Arithmetic"));
}

TEST_CASE("phlux bench figures draws the seven figures of CW 197") {
  const TemporaryFolder folder;
  const Outcome outcome = run({{"bench", "figures", "--out", "a folder"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  for (int figure = 1; figure <= 7; ++figure)
    CHECK(std::filesystem::exists(folder / ("a folder/figure-" + std::to_string(figure) + ".csv")));
  CHECK_THAT(outcome.out, Catch::Contains("reflectivity 0.44330"));
  if (outcome.err.find("python3-matplotlib") != std::string::npos) {
    WARN("no matplotlib: the drawings are not tested");
    return;
  }
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (int figure = 1; figure <= 7; ++figure) {
    const std::string name = "a folder/figure-" + std::to_string(figure);
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".png")), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".svg")), Catch::Contains("</svg>"));
  }
  CHECK_THAT(TemporaryFolder::read(folder / "a folder/index.html"),
             Catch::Contains("The figures of CW 197") && !Catch::Contains("is not here"));
}

TEST_CASE("phlux bench figures without matplotlib keeps the tables and names the package") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "python");
  folder.write("python/matplotlib.py", "raise ImportError('not installed')\n");
  const Outcome outcome =
      run({{"bench", "figures", "--out", "out"}, folder.path(), {{"PYTHONPATH", folder / "python"}}, {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 5);
  CHECK(outcome.is_one_line_error());
  CHECK_THAT(outcome.err, Catch::Contains("python3-matplotlib"));
  CHECK(std::filesystem::exists(folder / "out/figure-7.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/figure-7.svg"));
}

namespace {

const char* const scenes_columns =
    "scene,integrator,strategy,connect_or_weights,device,samples_per_pixel,seconds,relmse,variance_per_"
    "sample,"
    "variance_standard_error,top_share,seconds_per_sample,variance_times_seconds,";

std::string shipped(const std::string& name) {
  return PHLUX_SOURCE_DIR "/scenes/" + name + ".xml";
}

// bench scenes on small images, a second for each scene.
std::vector<std::string> scenes_command(const std::vector<std::string>& names,
                                        const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"bench",     "scenes", "--quick", "--side", "8",
                                        "--seconds", "1",      "--out",   "out"};
  for (const std::string& name : names)
    arguments.insert(arguments.end(), {"--scene", std::filesystem::exists(name) ? name : shipped(name)});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::string value_of(const std::string& row, const std::vector<std::string>& columns,
                     const std::string& name) {
  std::istringstream stream(row);
  std::string value;
  for (const std::string& column : columns) {
    std::getline(stream, value, ',');
    if (column == name) return value;
  }
  throw std::runtime_error("no column " + name);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> values;
  std::istringstream stream(line);
  for (std::string value; std::getline(stream, value, ',');) values.push_back(value);
  return values;
}

bool drawn(const Outcome& outcome) {
  if (outcome.err.find("python3-matplotlib") == std::string::npos) return true;
  WARN("no matplotlib: the charts are not tested");
  return false;
}

} // namespace

TEST_CASE("phlux bench scenes writes the contract's columns, a row for each method, charts and a report") {
  const TemporaryFolder folder;
  const Outcome outcome = run({scenes_command({"furnace-sphere", "point-light"}), folder.path(), {}, {}});
  CAPTURE(outcome.err, outcome.out);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/scenes.csv"));
  REQUIRE(lines.size() == 1 + 2 * 5);
  CHECK_THAT(lines[0], Catch::StartsWith(scenes_columns));
  const auto columns = split(lines[0]);
  int sound = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(columns_of(lines[i]) == columns_of(lines[0]));
    const auto value = [&](const std::string& name) { return value_of(lines[i], columns, name); };
    const std::string verdict = value("verdict");
    if (verdict == "refused") {
      CHECK_FALSE(value("reason").empty());
      CHECK(value("variance_per_sample").empty());
      CHECK(value("seconds").empty());
    } else {
      CHECK(std::stod(value("variance_measured")) > 0);
      CHECK(std::stod(value("seconds_per_sample")) > 0);
      CHECK(std::stoi(value("rounds")) >= 5);
    }
    if (verdict == "sound") {
      ++sound;
      CHECK(std::stod(value("variance_times_seconds")) ==
            Approx(std::stod(value("variance_per_sample")) * std::stod(value("seconds_per_sample")))
                .epsilon(1e-4));
      CHECK(std::stod(value("top_share")) < 1);
    } else {
      CHECK(value("variance_times_seconds").empty());
    }
  }
  CHECK(sound >= 3);
  CHECK_THAT(lines[6], Catch::StartsWith("point-light,path,exact,none,"));
  CHECK(value_of(lines[6], columns, "verdict") == "refused"); // no path hits a point
  const auto points = lines_of(TemporaryFolder::read(folder / "out/scenes-convergence.csv"));
  CHECK(points.size() > 5);
  CHECK(points[0] ==
        "scene,integrator,strategy,connect_or_weights,seconds,samples_per_pixel,relmse,relmse_least,"
        "relmse_most,relmse_expected,rounds,settings");
  for (const std::string& line : points) CHECK(columns_of(line) == columns_of(points[0]));
  CHECK(std::filesystem::exists(folder / "out/references/furnace-sphere.exr"));
  if (!drawn(outcome)) return;
  CHECK(outcome.exit_code == 0);
  const std::string html = TemporaryFolder::read(folder / "out/index.html");
  CHECK_THAT(html, Catch::Contains("point-light: speed and accuracy") && Catch::Contains("</svg>"));
  for (const char* chart : {"overview", "furnace-sphere-convergence", "furnace-sphere-efficiency",
                            "furnace-sphere-times", "furnace-sphere-images", "furnace-sphere-errors"}) {
    const std::string name = std::string("out/scenes-") + chart;
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".svg")), Catch::Contains("prefers-color-scheme:dark"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + ".png")), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(folder / (name + "-dark.png")), Catch::StartsWith("\x89PNG"));
  }
}

TEST_CASE("phlux bench scenes goes on where it was interrupted") {
  const TemporaryFolder folder;
  const auto rows_of = [&](const std::string& scene) {
    std::vector<std::string> rows;
    for (const std::string& line : lines_of(TemporaryFolder::read(folder / "out/scenes.csv")))
      if (line.starts_with(scene + ",")) rows.push_back(line);
    return rows;
  };
  (void)run({scenes_command({"furnace-sphere"}), folder.path(), {}, {}});
  const auto first = rows_of("furnace-sphere");
  REQUIRE(first.size() == 5);

  const auto both = scenes_command({"furnace-sphere", "cornell-box"});
  const Outcome stopped = run({both, folder.path(), {}, std::chrono::milliseconds(300)});
  CAPTURE(stopped.err, stopped.out);
  CHECK(stopped.exit_code == 130);
  CHECK(rows_of("furnace-sphere") == first);
  CHECK(rows_of("cornell-box").empty());

  const Outcome whole = run({both, folder.path(), {}, {}});
  CHECK_THAT(whole.out, Catch::Contains("furnace-sphere: measured already"));
  CHECK(rows_of("furnace-sphere") == first);
  const auto second = rows_of("cornell-box");
  CHECK(second.size() == 5);
  if (drawn(whole)) CHECK(whole.exit_code == 0);

  // Another seed is another measurement; the other scene's rows stay.
  (void)run({scenes_command({"furnace-sphere"}, {"--seed", "2"}), folder.path(), {}, {}});
  CHECK(rows_of("furnace-sphere").size() == 5);
  CHECK(rows_of("furnace-sphere") != first);
  CHECK(rows_of("cornell-box") == second);
}

TEST_CASE("phlux bench scenes measures a strategy that is added beside what is there") {
  const TemporaryFolder folder;
  (void)run({scenes_command({"furnace-sphere"}), folder.path(), {}, {}});
  const auto before = lines_of(TemporaryFolder::read(folder / "out/scenes.csv"));
  (void)run({scenes_command({"furnace-sphere"}, {"--strategy", "exact", "--strategy", "lobe-ks"}),
             folder.path(),
             {},
             {}});
  const auto after = lines_of(TemporaryFolder::read(folder / "out/scenes.csv"));
  CHECK(after.size() == 1 + 10);
  for (const std::string& line : before)
    if (line.find("refused") == std::string::npos) CHECK(std::ranges::count(after, line) == 1);
}

namespace {

// Small images, half a second for each cell.
std::vector<std::string> stability_command(const std::vector<std::string>& cells,
                                           const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"bench",     "stability", "--quick", "--side", "8",
                                        "--seconds", "0.5",       "--out",   "out"};
  for (const std::string& cell : cells) arguments.insert(arguments.end(), {"--cell", cell});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

} // namespace

TEST_CASE("phlux bench stability writes a row for each cell and method, charts and a section of the report") {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({stability_command({"1,.3", "100,.0001"}, {"--method", "path none", "--method", "path light"}),
           folder.path(),
           {},
           {}});
  CAPTURE(outcome.err, outcome.out);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/stability.csv"));
  REQUIRE(lines.size() == 1 + 2 * 2);
  CHECK_THAT(lines[0], Catch::StartsWith("exponent,light_radius,") && Catch::EndsWith(",clock,settings"));
  // Else as the table of scenes.
  CHECK_THAT(lines[0], Catch::Contains(std::string(scenes_columns).substr(std::string("scene").size())));
  const auto columns = split(lines[0]);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(columns_of(lines[i]) == columns_of(lines[0]));
    CHECK(value_of(lines[i], columns, "reference_by") == "bidir balance");
    CHECK(std::stod(value_of(lines[i], columns, "reference_relmse")) > 0);
    CHECK(std::stod(value_of(lines[i], columns, "processor_seconds_per_sample")) > 0);
    CHECK(value_of(lines[i], columns, "variance_times_seconds").empty() ==
          (value_of(lines[i], columns, "verdict") != "sound"));
  }
  CHECK_THAT(lines[1], Catch::StartsWith("1,0.3,path,exact,none,"));
  CHECK_THAT(lines[3], Catch::StartsWith("100,0.0001,path,exact,none,"));
  CHECK(value_of(lines[3], columns, "verdict") == "suspect"); // directions do not hit so small a light
  CHECK_THAT(outcome.out, Catch::Contains("path none suspect"));
  if (!has_charts(outcome)) return;
  CHECK_THAT(TemporaryFolder::read(folder / "out/index.html"), Catch::Contains("Where methods fail"));
  for (const char* chart : {"best", "cost", "scene"}) {
    const std::string name = folder / (std::string("out/stability-") + chart);
    CHECK_THAT(TemporaryFolder::read(name + ".svg"), Catch::Contains("prefers-color-scheme:dark"));
    CHECK_THAT(TemporaryFolder::read(name + ".png"), Catch::StartsWith("\x89PNG"));
    CHECK_THAT(TemporaryFolder::read(name + "-dark.png"), Catch::StartsWith("\x89PNG"));
  }
}

TEST_CASE("phlux bench stability goes on where it was interrupted") {
  const TemporaryFolder folder;
  const auto rows = [&] { return lines_of(TemporaryFolder::read(folder / "out/stability.csv")); };
  const std::vector<std::string> fast = {"--method", "path light"};
  const Outcome one = run({stability_command({"10,.1"}, fast), folder.path(), {}, {}});
  CHECK((!has_charts(one) || std::filesystem::exists(folder / "out/stability-cost.svg")));
  const auto first = rows();
  REQUIRE(first.size() == 2);

  std::vector<std::string> both = stability_command({"10,.1", "10,.01"}, fast);
  const Outcome stopped = run({both, folder.path(), {}, std::chrono::milliseconds(100)});
  CAPTURE(stopped.err, stopped.out);
  CHECK(stopped.exit_code == 130);
  CHECK(rows() == first);

  const Outcome whole = run({both, folder.path(), {}, {}});
  CHECK_THAT(whole.out, Catch::Contains("1 of 2 cells are measured already"));
  REQUIRE(rows().size() == 3);
  CHECK(rows()[1] == first[1]);

  // A method that is added joins what is there; another seed is another measurement.
  (void)run({stability_command({"10,.1"}, {"--method", "path none"}), folder.path(), {}, {}});
  CHECK(rows().size() == 4);
  (void)run({stability_command({"10,.1"}, {"--method", "path light", "--seed", "2"}), folder.path(), {}, {}});
  REQUIRE(rows().size() == 3); // and that of the other cell
  CHECK(rows()[2] != first[1]);
}

TEST_CASE("phlux bench precision writes a row for each width, its charts and a section of the report") {
  if (!phlux::device::open_devices({}).front().info.doubles) return;
  const TemporaryFolder folder;
  const std::string scene = shipped("furnace-sphere");
  const Outcome outcome =
      run({{"bench", "precision", "--quick", "--width", "4", "--scene", scene, "--out", "out"},
           folder.path(),
           {},
           {}});
  CAPTURE(outcome.err);
  const auto lines = lines_of(TemporaryFolder::read(folder / "out/precision.csv"));
  REQUIRE(lines.size() == 3);
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  CHECK_THAT(lines[1], Catch::StartsWith("furnace-sphere,path,1,"));
  CHECK_THAT(lines[2], Catch::StartsWith("furnace-sphere,path,4,"));
  if (!has_charts(outcome)) return;
  for (const char* chart : {"tradeoff", "time"})
    CHECK_THAT(TemporaryFolder::read(folder / (std::string("out/precision-") + chart + ".svg")),
               Catch::Contains("</svg>"));
  CHECK_THAT(TemporaryFolder::read(folder / "out/index.html"), Catch::Contains("Float32 against float64"));
}

TEST_CASE("phlux bench: bad input is one line and its exit code") {
  struct Bad {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  };
  const std::vector<Bad> bad = {
      {{}, 2, "bench: no command"},
      {{"ray"}, 2, "did you mean rays?"},
      {{"rays", "--triangles", "3"}, 2, "--triangles 3: must be a whole number from 36"},
      {{"rays", "--triangles", "36,"}, 2, "--triangles ''"},
      {{"rays", "--trangles", "36"}, 2, "did you mean --triangles?"},
      {{"rays", "--width", "3"}, 2, "--width 3"},
      {{"rays", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"rays", "--out", "file"}, 5, "file"},
      {{"rays", "--device", "none such"}, 4, "none such"},
      {{"scenes", "--strategy", "exct"}, 2, "did you mean exact?"},
      {{"scenes", "--scene", "none.xml"}, 3, "none.xml"},
      {{"scenes", "--scene", "broken.xml"}, 3, "broken.xml"},
      {{"scenes", "--scene", "a/scene.xml", "--scene", "b/scene.xml"}, 2, "has the name of a/scene.xml"},
      {{"scenes", "--seconds", "0"}, 2, "--seconds 0"},
      {{"scenes", "--side", "0"}, 2, "--side 0"},
      {{"scenes", "--out", "/proc/phlux", "--scene", shipped("furnace-box")}, 5, "/proc/phlux"},
      {{"scenes", "--out", "file", "--scene", shipped("furnace-box")}, 5, "file"},
      {{"scenes", "--device", "none such", "--scene", shipped("furnace-box")}, 4, "none such"},
      {{"sampling", "--strategy", "magic"}, 2, "--strategy magic: must be one of uniform"},
      {{"sampling", "--strategy", "exct"}, 2, "did you mean exact?"},
      {{"sampling", "--samples", "0"}, 2, "--samples 0"},
      {{"sampling", "--case", ".4,.05,50"}, 2, "must be KD,KS,N,DEGREES"},
      {{"sampling", "--case", ".4,.7,50,30"}, 2, "at most 1"},
      {{"sampling", "--case", ".4,.05,-1,30"}, 2, "--case -1: must be a number from 0 to"},
      {{"sampling", "--case", ".4,.05,50,90"}, 2, "--case 90"},
      {{"sampling", "--integrand", "moon"}, 2, "--integrand moon: must be one of constant"},
      {{"sampling", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"sampling", "--device", "none such"}, 4, "none such"},
      {{"stability", "--cell", "10"}, 2, "--cell 10: must be N,RADIUS"},
      {{"stability", "--cell", "10,.4"}, 2, "--cell .4: must be a number from 0.0001 to 0.3"},
      {{"stability", "--cell", "10,0"}, 2, "--cell 0: must be"},
      {{"stability", "--cell", "-1,.1"}, 2, "--cell -1: must be"},
      {{"stability", "--method", "path mi"}, 2, "did you mean path mis?"},
      {{"stability", "--strategy", "exct"}, 2, "did you mean exact?"},
      {{"stability", "--seconds", "0"}, 2, "--seconds 0"},
      {{"stability", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"stability", "--out", "file"}, 5, "file"},
      {{"stability", "--device", "none such"}, 4, "none such"},
      {{"arithmetic", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"arithmetic", "--width", "5"}, 2, "--width 5"},
      {{"precision", "--scene", "broken.xml"}, 3, "broken.xml"},
      {{"precision", "--out", "/proc/phlux", "--scene", shipped("furnace-box")}, 5, "/proc/phlux"},
      {{"figures", "--out", "/proc/phlux"}, 5, "/proc/phlux"},
      {{"figures", "--out", "file"}, 5, "file"},
      {{"figures", "--device", "none such"}, 4, "none such"},
  };
  const TemporaryFolder folder;
  folder.write("file", "");
  folder.write("broken.xml", "<scene version=");
  for (const auto& [arguments, exit_code, message] : bad) {
    std::vector<std::string> all = {"bench"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run({all, folder.path(), {}, {}});
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.exit_code == exit_code);
    CHECK(outcome.is_one_line_error());
    CHECK_THAT(outcome.err, Catch::Contains(message));
  }
}
