// What the fuzzers of meshes have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <spdlog/spdlog.h>

#include "errors.h"
#include "input.h"
#include "scene_file/mesh.h"

inline void check(const phlux::scene::Mesh& mesh) {
  const auto finite = [](const auto& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const bool in_range = std::ranges::all_of(
      mesh.triangles, [&](const auto& t) { return std::ranges::max(t) < mesh.positions.size(); });
  if (!in_range || !std::ranges::all_of(mesh.positions, finite) || !std::ranges::all_of(mesh.normals, finite))
    std::abort();
}

/// Reads the bytes with smooth and with flat normals and aborts if the mesh is not sound.
template<class Load>
void fuzz_mesh(const Load& load, const std::uint8_t* bytes, std::size_t count) {
  spdlog::set_level(spdlog::level::off);
  const Input input(bytes, count);
  for (const bool flat : {false, true}) {
    phlux::scene_file::MeshRequest request;
    request.file = input.file();
    request.named_at = {std::make_shared<const std::string>("scene.xml"), 1};
    request.face_normals = flat;
    request.texture_coordinates = !flat;
    try {
      for (phlux::scene_file::MeshPart& part : load(request).parts)
        check(phlux::scene_file::finish_mesh(std::move(part), request));
    } catch (const phlux::SceneError&) {
    }
  }
}
