#include <catch2/catch.hpp>

#include "cli/bench_tables.h"
#include "device/device.h"
#include "temporary_folder.h"

TEST_CASE("phlux bench rays writes the contract's columns") {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({{"bench", "rays", "--triangles", "36,1000", "--out", "out/new"}, folder.path(), {}, {}});
  CAPTURE(outcome.err);
  if (has_charts(outcome)) {
    CHECK_THAT(TemporaryFolder::read(folder / "out/new/index.html"),
               Catch::Contains("Rays, compared with Embree"));
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

TEST_CASE("phlux bench roulette, samplers and techniques: rows, charts, and the answer last") {
  const TemporaryFolder folder;
  const Outcome roulette =
      run({{"bench", "roulette", "--quick", "--samples", "4", "--scene", shipped("cornell-box"), "--out", ".",
            "--integrator", "light", "--roulette", "kd-ks"},
           folder.path(),
           {},
           {}});
  CAPTURE(roulette.err);
  const bool drawn = has_charts(roulette);
  auto lines = lines_of(TemporaryFolder::read(folder / "roulette.csv"));
  REQUIRE(lines.size() == 5); // the defaults, kd-ks twice, none
  CHECK_THAT(lines[2], Catch::StartsWith("cornell-box,light,exact,kd-ks,1,"));
  CHECK_THAT(lines[4], Catch::StartsWith("cornell-box,light,exact,none,-1,"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  CHECK_THAT(roulette.out, Catch::Contains("\nlight: --r"));

  const Outcome samplers =
      run({{"bench", "samplers", "--quick", "--samples", "64", "--scene", shipped("cornell-box"), "--out",
            ".", "--integrator", "path", "--sampler", "lattice"},
           folder.path(),
           {},
           {}});
  CAPTURE(samplers.err);
  CHECK(has_charts(samplers) == drawn);
  lines = lines_of(TemporaryFolder::read(folder / "samplers.csv"));
  REQUIRE(lines.size() == 5); // two samplers with 16 and 64 samples
  CHECK_THAT(lines[1], Catch::StartsWith("cornell-box,path,independent,16,"));
  CHECK_THAT(lines[4], Catch::StartsWith("cornell-box,path,lattice,64,"));
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  CHECK_THAT(samplers.out,
             Catch::Contains("\npath: for the error of 64 independent samples per pixel, --sampler l"));

  const Outcome techniques = run(
      {{"bench", "techniques", "--quick", "--samples", "4", "--scene", shipped("cornell-box"), "--out", "."},
       folder.path(),
       {},
       {}});
  CAPTURE(techniques.err);
  CHECK(has_charts(techniques) == drawn);
  lines = lines_of(TemporaryFolder::read(folder / "techniques.csv"));
  REQUIRE(lines.size() > 10);
  for (const std::string& line : lines) CHECK(columns_of(line) == columns_of(lines[0]));
  CHECK_THAT(techniques.out,
             Catch::Contains("\ncornell-box: (") && Catch::Contains(" of the variance; it brings "));
  if (drawn)
    for (const char* title :
         {"Russian roulette in whole renders", "Low-discrepancy samplers", "Techniques of bidir balance"})
      CHECK_THAT(TemporaryFolder::read(folder / "index.html"), Catch::Contains(title));
}

TEST_CASE("phlux bench sampling writes the contract's columns, a row for each strategy and case") {
  const TemporaryFolder folder;
  Invocation invocation{{"bench", "sampling", "--out", ".", "--samples", "1000", "--strategy", "exact",
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

  // It ends with the verdict on the case with two strategies. Another cost of a ray needs no new
  // measurements.
  const std::string verdict = TemporaryFolder::read(folder / "sampling.verdict.txt");
  CHECK_THAT(verdict,
             Catch::StartsWith("--strategy exact without roulette (the default before edge 5): no variance"));
  CHECK(outcome.out.ends_with("\n\n" + verdict));
  invocation.arguments.insert(invocation.arguments.end(), {"--ray-cost", "100"});
  const Outcome again = run(invocation);
  CHECK(again.exit_code == outcome.exit_code);
  CHECK_THAT(again.out, Catch::Contains("2 of 2 measurements are there") &&
                            Catch::Contains("(--case 0.4,0.05,50,30; cost: processor time of the sampler "
                                            "plus 100 ns for each reflected ray"));
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
    CHECK_THAT(TemporaryFolder::read(chart + ".pdf"), Catch::StartsWith("%PDF"));
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
  const Outcome outcome =
      run({{"bench", "figures", "--out", "out"}, folder.path(), without_matplotlib(folder), {}});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 5);
  CHECK(outcome.is_one_line_error());
  CHECK_THAT(outcome.err, Catch::Contains("python3-matplotlib"));
  CHECK(std::filesystem::exists(folder / "out/figure-7.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/figure-7.svg"));
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
  CHECK_THAT(TemporaryFolder::read(folder / "out/index.html"),
             Catch::Contains("Float32 compared with float64"));
}

TEST_CASE("phlux bench: bad input is one line and its exit code") {
  struct Bad {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  };
  const std::string retro = PHLUX_SOURCE_DIR "/scenes/lobes/retro.cl";
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
      {{"sampling", "--ray-cost", "-1"}, 2, "--ray-cost -1: must be a number from 0 to"},
      {{"sampling", "--integrand", "moon"}, 2, "--integrand moon: must be one of constant"},
      {{"sampling", "--lobe", "none.cl"}, 3, "none.cl"},
      {{"sampling", "--lobe", "exact.cl"}, 2, "a sampling strategy is called exact too"},
      {{"sampling", "--set", "exponent=2"}, 2, "--set: needs --lobe"},
      {{"sampling", "--lobe", retro, "--set", "exponent"}, 2, "--set exponent: must be NAME=VALUE"},
      {{"sampling", "--lobe", retro, "--set", "exponent=0"}, 2, "must be from 1 to"},
      {{"sampling", "--lobe", retro, "--strategy", "exact"}, 2, "--lobe: excludes --strategy"},
      {{"sampling", "--strategy", "none.cl"}, 2, "--strategy none.cl: cannot be read"},
      {{"sampling", "--strategy", "empty.cl"}, 3, "empty.cl: does not define phong_density"},
      {{"sampling", "--lobe", retro, "--lobe", retro}, 3, "retro"},
      {{"sampling", "--lobe", retro, "--lobe", "b.cl", "--set", "exponent=2"},
       2,
       "--set exponent=2: 2 models"},
      {{"sampling", "--lobe", retro, "--model", "roughconductor"}, 2, "--lobe: excludes --strategy"},
      {{"sampling", "--model", "mirror"}, 2, "--model mirror"},
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
  folder.write("empty.cl", "");
  folder.write("file", "");
  folder.write("broken.xml", "<scene version=");
  folder.write("exact.cl", "#define EXACT_PARAMETERS(COLOUR, NUMBER) NUMBER(n, 1, 0, 2, \"\")\n"
                           "// exact_evaluate exact_sample exact_reflectivity\n");
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
