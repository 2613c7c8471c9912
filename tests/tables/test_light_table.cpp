// The probabilities with which light paths and light samples choose a light.
#include "tables/light_table.h"

#include <catch2/catch.hpp>

#include "lobes/models.h"
#include "tables/host_scene.h"

using namespace phlux;

namespace {

using scene::Rgb;
using settings::Connect;
using settings::Settings;

// A lamp of this radiance above a floor. The lamp is light 0.
scene::Scene lamp_over_floor(double radiance) {
  scene::Scene scene;
  scene.materials = {lobes::diffuse(Rgb(0.5))};
  scene.patches.resize(2);
  scene.patches[1].edge_v *= -1.0;
  scene.patches[1].origin = {0, 0, 2};
  scene.patches[1].surface.area_emitter = 0;
  scene.area_emitters = {{Rgb(radiance)}};
  return scene;
}

tables::LightTable table_of(const scene::Scene& scene, const std::string& integrator, Connect connect) {
  Settings settings;
  settings.integrator = integrator;
  settings.connect = connect;
  return tables::prepare(scene, settings, 8).lights;
}

void check_sums(const tables::LightTable& table) {
  double for_paths = 0, for_samples = 0;
  for (const LightRecord& record : table.records) {
    for_paths += record.probability;
    for_samples += record.sample_probability;
  }
  CHECK(for_paths == Approx(1));
  CHECK(for_samples == Approx(1));
}

} // namespace

TEST_CASE("light samples leave a constant sky to hits, if hits count and there is another light") {
  scene::Scene scene = lamp_over_floor(10);
  scene.point_lights.push_back({{0, 0, 1}, Rgb(20)});
  scene.constant_radiance = Rgb(0.5);
  for (const auto& [integrator, connect] :
       {std::pair("path", Connect::mis), std::pair("bidir", Connect::none)}) {
    CAPTURE(integrator);
    const tables::LightTable table = table_of(scene, integrator, connect);
    REQUIRE(table.records.size() == 3);
    REQUIRE(table.sky == 2);
    CHECK_FALSE(table.samples_sky());
    CHECK(table.records[2].probability > 0.1);
    CHECK(table.records[0].sample_probability / table.records[1].sample_probability ==
          Approx(table.records[0].probability / table.records[1].probability));
    CHECK(table.tree_probability == Approx(1));
    check_sums(table);
  }
}

TEST_CASE("without a sky, light samples choose as light paths do") {
  scene::Scene scene = lamp_over_floor(10);
  scene.point_lights.push_back({{0, 0, 1}, Rgb(20)});
  for (const Connect connect : {Connect::light, Connect::mis}) {
    const tables::LightTable table = table_of(scene, "path", connect);
    for (const LightRecord& record : table.records) CHECK(record.sample_probability == record.probability);
    check_sums(table);
  }
}

TEST_CASE("light samples choose a sky that hits do not find, that is a map, or that is the only light") {
  scene::Scene constant = lamp_over_floor(10), map = constant;
  constant.constant_radiance = Rgb(0.5);
  map.environment.emplace();
  map.environment->width = 2;
  map.environment->height = 1;
  map.environment->texels = {glm::vec3(1), glm::vec3(2)};
  for (const auto& [scene, connect] : {std::pair(&constant, Connect::light), std::pair(&map, Connect::mis)}) {
    const tables::LightTable table = table_of(*scene, "path", connect);
    CHECK(table.samples_sky());
    for (const LightRecord& record : table.records)
      CHECK(record.sample_probability == Approx(record.probability));
    check_sums(table);
  }
  scene::Scene alone = lamp_over_floor(0);
  alone.constant_radiance = Rgb(0.5);
  const tables::LightTable table = table_of(alone, "path", Connect::mis);
  CHECK(table.samples_sky());
  CHECK(table.records[0].sample_probability == 0);
  check_sums(table);
}
