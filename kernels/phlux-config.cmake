# find_package(phlux) gives phlux::kernels: a target whose include directory holds the kernel files, for programs that
# use kernels/phong (phong/load.h). PHLUX_KERNELS is that directory.
get_filename_component(PHLUX_KERNELS "${CMAKE_CURRENT_LIST_DIR}/../../phlux/kernels" ABSOLUTE)
if(NOT TARGET phlux::kernels)
  add_library(phlux::kernels INTERFACE IMPORTED)
  set_target_properties(phlux::kernels PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${PHLUX_KERNELS}")
endif()
