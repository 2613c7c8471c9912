# Definitions for cli/version.cpp. Every build asks git for the commit; a new one recompiles only version.cpp.
set(libraries)
foreach(library "OpenEXR ${OpenEXR_VERSION}" "Embree ${embree_VERSION}" "pugixml ${pugixml_VERSION}"
        "fmt ${fmt_VERSION}" "spdlog ${spdlog_VERSION}" "CLI11 ${CLI11_VERSION}"
        "nlohmann-json ${nlohmann_json_VERSION}" "libpng ${PNG_VERSION_STRING}" "cereal ${cereal_VERSION}"
        "xxHash ${XXHASH_VERSION}")
  string(REGEX REPLACE " $" " of unknown version" library "${library}")
  list(APPEND libraries ${library})
endforeach()
list(JOIN libraries ", " libraries)

set(commit ${PROJECT_BINARY_DIR}/generated/commit.h)
find_package(Git QUIET)
add_custom_target(phlux_commit
  COMMAND ${CMAKE_COMMAND} "-DGIT=${GIT_EXECUTABLE}" -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${commit}
          -P ${CMAKE_CURRENT_LIST_DIR}/write_commit.cmake
  BYPRODUCTS ${commit}
  VERBATIM)
add_dependencies(phlux_cli phlux_commit)
set_source_files_properties(${PROJECT_SOURCE_DIR}/host/cli/version.cpp PROPERTIES
  INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR}/generated
  OBJECT_DEPENDS ${commit}
  COMPILE_DEFINITIONS "PHLUX_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}\";PHLUX_LIBRARIES=\"${libraries}\"")
