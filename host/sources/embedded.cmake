# Puts every file of kernels/ into phlux_sources, so that the installed program needs none of them.
file(GLOB_RECURSE kernels RELATIVE ${PROJECT_SOURCE_DIR}/kernels CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/kernels/*.h ${PROJECT_SOURCE_DIR}/kernels/*.cl)
list(TRANSFORM kernels PREPEND ${PROJECT_SOURCE_DIR}/kernels/ OUTPUT_VARIABLE kernel_paths)
list(JOIN kernels "|" kernel_names)

set(embedded ${PROJECT_BINARY_DIR}/embedded_kernels.cpp)
add_custom_command(
  OUTPUT ${embedded}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/kernels "-DFILES=${kernel_names}" -DOUTPUT=${embedded}
          -P ${CMAKE_CURRENT_LIST_DIR}/embed_kernels.cmake
  DEPENDS ${kernel_paths} ${CMAKE_CURRENT_LIST_DIR}/embed_kernels.cmake
  COMMENT "Embedding the kernels"
  VERBATIM)
target_sources(phlux_sources PRIVATE ${embedded})
